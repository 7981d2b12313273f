#include "cli/facts_file.h"

#include <fmt/format.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "report/text_file.h"
#include "rpf/error.h"

namespace rpf::cli {
namespace {

using nlohmann::json;

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw Error(ErrorKind::input, fmt::format("--facts \"{}\": {}", path, what));
}

constexpr std::size_t most_bytes = 1 << 20;  // some hundred numbers and names of slots

std::string text_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::string text(most_bytes + 1, '\0');
  if (!file.read(text.data(), static_cast<std::streamsize>(text.size())) && file.gcount() == 0)
    refuse(path, "cannot be read; name a file that rpf facts wrote");
  text.resize(static_cast<std::size_t>(file.gcount()));
  return text;
}

/// Facts steer the filter as if they had been found, so those that were edited must not be taken.
std::string seal_of(const json& facts, const FactsFile& file) {
  return hash_of_text(fmt::format("{} {} {} {}", facts.dump(), file.origin.input, file.origin.settings, file.ends));
}

FactsFile parse(const std::string& path) {
  const std::string text = text_of_file(path);
  try {
    const json all = text.size() > most_bytes ? json() : json::parse(text);
    FactsFile file{all.at("facts").dump(),
                   {all.at("input").get<std::string>(), all.at("settings").get<std::string>()},
                   all.at("input_ends").get<std::string>()};
    if (all.at("seal") == seal_of(all.at("facts"), file)) return file;
  } catch (const json::exception& /*error*/) {
  }
  refuse(path, "is none that rpf facts wrote, or was changed since; make it with rpf facts FILE -o FACTS");
}

}  // namespace

Origin frame_origin(const std::string& input_hash, Settings settings, const std::vector<std::string>& map) {
  settings.crop.reset();
  return {input_hash, hash_of_settings(settings, map)};
}

void write_facts(const std::string& path, const FactsFile& file) {
  json all;
  all["facts"] = json::parse(file.facts);
  all["input"] = file.origin.input;
  all["input_ends"] = file.ends;
  all["seal"] = seal_of(all["facts"], file);
  all["settings"] = file.origin.settings;
  report::write_text(path, all.dump(1) + "\n");
}

FactsFile read_facts(const std::string& path, const std::string& input, const Settings& settings,
                     const std::vector<std::string>& map) {
  FactsFile file = parse(path);
  if (file.origin.settings != frame_origin("", settings, map).settings)
    refuse(path, "was found with other settings, or by another version; give rpf facts the options that filter");
  if (file.ends != hash_of_ends(input))
    refuse(path, fmt::format("is of another file than \"{}\"; make it with rpf facts \"{}\"", input, input));
  return file;
}

}  // namespace rpf::cli
