#include "cli/facts_file.h"

#include <fmt/format.h>

#include <fstream>
#include <iterator>
#include <nlohmann/json.hpp>

#include "report/text_file.h"
#include "rpf/error.h"

namespace rpf::cli {
namespace {

using nlohmann::json;

[[noreturn]] void refuse(const std::string& path, const std::string& what) {
  throw Error(ErrorKind::input, fmt::format("--facts \"{}\": {}", path, what));
}

FactsFile parse(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) refuse(path, "cannot be opened; name a file that rpf facts wrote");
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  try {
    const json all = json::parse(text);
    return {all.at("facts").dump(),
            {all.at("input").get<std::string>(), all.at("settings").get<std::string>()},
            all.at("input_ends").get<std::string>()};
  } catch (const json::exception& /*error*/) {
    refuse(path, "is none that rpf facts wrote; make it with rpf facts FILE -o FACTS");
  }
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
