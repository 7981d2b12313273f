#include "cli/dropped.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "cli/print.h"
#include "rpf/density.h"
#include "rpf/error.h"
#include "rpf/outputs.h"

namespace rpf::cli {
namespace {

std::string list_of(const char* what, std::vector<std::string> names) {
  constexpr std::size_t listed = 12;
  if (names.empty()) return "";
  const std::string rest = names.size() > listed ? fmt::format(" and {} more", names.size() - listed) : "";
  names.resize(std::min(names.size(), listed));
  return fmt::format("{} {}{}", what, fmt::join(names, ", "), rest);
}

/// Empty where nothing is dropped.
std::string dropped_of(const SampleFileInfo& info) {
  std::vector<std::string> channels;
  for (const SampleFileChannel& channel : info.channels)
    if (channel.slot.empty()) channels.push_back(channel.name);
  const std::string names = list_of("channels", channels), attributes = list_of("attributes", info.dropped_attributes);
  return names + (names.empty() || attributes.empty() ? "" : "; ") + attributes;
}

}  // namespace

SampleFileInfo as_image(SampleFileInfo info, const std::string& output) {
  for (SampleFileChannel& channel : info.channels)
    if (channel.slot == "A" && !output.empty() && !stores_alpha(output)) channel.slot.clear();
  return info;
}

void tell_dropped(const SampleFileInfo& info) {
  const std::string dropped = dropped_of(info);
  if (!dropped.empty()) remark("rpf: note: \"{}\": not in the result: {}\n", info.path, dropped);
}

void tell_not_finite(const SampleBuffer& samples) {
  if (const std::size_t count = count_not_finite(samples); count > 0)
    remark("rpf: note: samples left out: R, G or B not finite: {}\n", count);
}

void check_in_place(const SampleFileInfo& info, const std::string& output) {
  if (output.empty() || !is_same_file(info.path, output)) return;
  const std::string dropped = dropped_of(info);
  if (!dropped.empty())
    throw Error(ErrorKind::usage,
                fmt::format("\"{}\" would replace its input and lose {}; name another file to write", output, dropped));
  if (info.value_bits < 32 && info.value_bits > stored_bits(output))
    throw Error(ErrorKind::usage, fmt::format("\"{}\" would replace its input and keep {} of its {} bits a value; name "
                                              "an .exr file to write",
                                              output, stored_bits(output), info.value_bits));
}

}  // namespace rpf::cli
