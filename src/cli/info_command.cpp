#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "cli/commands.h"
#include "cli/environment.h"
#include "cli/filter_options.h"
#include "cli/needs.h"
#include "cli/print.h"
#include "rpf/presets.h"
#include "rpf/rows.h"

namespace rpf::cli {
namespace {

std::string type_name(PixelType type) {
  switch (type) {
    case PixelType::half_float:
      return "half";
    case PixelType::full_float:
      return "float";
    case PixelType::unsigned_int:
      return "uint";
  }
  return "?";
}

void print_file(const SampleFileInfo& info) {
  const auto pixels = static_cast<double>(info.data_window.pixel_count());
  print("{}\n  data window {}, display window {}, compression {}\n", info.path, text_of(info.data_window),
        text_of(info.display_window), info.compression);
  print("  {} samples: {} to {} a pixel, {:.2f} on average, {} empty pixels\n", info.sample_count, info.min_samples,
        info.max_samples, static_cast<double>(info.sample_count) / pixels, info.empty_pixels);
}

void print_channels(const SampleFileInfo& info, const std::vector<ChannelSurvey>& surveys) {
  print("  {:<20} {:<20} {:<6} {:>12} {:>12}  {}\n", "slot", "<- channel", "type", "least", "largest", "remarks");
  for (const SampleFileChannel& channel : info.channels) {
    const auto found =
        std::find_if(surveys.begin(), surveys.end(), [&](const ChannelSurvey& s) { return s.slot == channel.slot; });
    if (found == surveys.end()) {
      print("  {:<20} {:<20} {:<6}\n", "(not used)", channel.name, type_name(channel.type));
      continue;
    }
    std::string remarks = found->constant ? "constant" : "";
    if (found->non_finite > 0) remarks += fmt::format(" {} non-finite", found->non_finite);
    print("  {:<20} {:<20} {:<6} {:>12.6g} {:>12.6g}  {}\n", channel.slot, channel.name, type_name(channel.type),
          found->minimum, found->maximum, remarks);
  }
}

/// What contradicts the convention, and what no result will hold.
void print_remarks(const SampleFileInfo& info, const std::vector<InputNote>& notes) {
  for (const InputNote& note : notes)
    print("  note: {}: {} (first at pixel {},{})\n", note.what, note.count, note.x, note.y);
  if (!info.dropped_attributes.empty())
    print("  attributes of types that are not read: {}\n", fmt::format("{}", fmt::join(info.dropped_attributes, ", ")));
}

/// `kind`: preset or profile.
void print_need(const SampleFileInfo& info, const SampleRows& rows, const std::string& kind, const std::string& name,
                std::uint64_t limit) {
  Settings settings = settings_of(parse_filter_options({"--" + kind, name}));  // backend and threads as in filtering
  settings.max_memory = limit;                                                 // what a network takes depends on it
  const std::uint64_t need = predicted_memory(info, settings);
  const bool fits = need <= limit;
  print("  predicted peak memory, {} {}, {} threads: {:.0f} MB{}\n", name, kind, settings.threads,
        static_cast<double>(need) / megabyte, fits ? "" : ", more than the limit");
  if (fits) return;
  const RowsMemory by_rows = predict_rows_memory(rows, info.max_samples, settings);
  if (by_rows.bytes <= limit) print("    so {}\n", text_of(by_rows));
}

void print_memory(const SampleFileInfo& info, const SampleRows& rows, std::uint64_t limit) {
  for (const PresetInfo& preset : presets()) print_need(info, rows, "preset", preset.name, limit);
  for (const char* profile : {"thesis", "paper"}) print_need(info, rows, "profile", profile, limit);
}

}  // namespace

Command add_info_command(CLI::App& app) {
  struct Options {
    std::string file;
    std::vector<std::string> map;
    std::uint64_t max_memory_mb = 0;
  };
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand("info", "Say what a sample file holds and what filtering it would take");
  command->add_option("FILE", options->file, "Sample file (deep OpenEXR or raw floats)")->required();
  add_map_option(*command, options->map);
  add_memory_option(*command, options->max_memory_mb);
  return [options] {
    const SampleReadOptions read_options = read_options_of(options->map, memory_limit(options->max_memory_mb));
    const SampleFileInfo info = inspect_samples(options->file, read_options);
    const auto rows = open_sample_rows(options->file, read_options);
    const RowSurvey found = survey_rows(*rows);
    print_file(info);
    print_channels(info, found.channels);
    print_remarks(info, found.notes);
    print_memory(info, *rows, read_options.max_memory);
    return 0;
  };
}

}  // namespace rpf::cli
