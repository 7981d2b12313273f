#include "bench/results_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "rpf/error.h"

namespace rpf::bench {
namespace {

using Json = nlohmann::ordered_json;

std::string whole_lines(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  const std::string text{std::istreambuf_iterator<char>(file), {}};
  const auto end = text.rfind('\n');
  return end == std::string::npos ? "" : text.substr(0, end + 1);
}

Json parse(const std::string& path, const std::string& line, std::size_t number) {
  Json json = Json::parse(line, nullptr, false);
  if (!json.is_object() || !json.contains("key") || !json["key"].is_string())
    throw Error(
        ErrorKind::input,
        fmt::format("\"{}\", line {}: no result of rpf bench sweep or rpf study; name another file", path, number));
  return json;
}

}  // namespace

ResultsFile::ResultsFile(std::string path) : path_(std::move(path)) {
  const std::string text = whole_lines(path_);
  for (std::size_t begin = 0, end = 0; begin < text.size(); begin = end + 1) {
    end = text.find('\n', begin);
    lines_.push_back(parse(path_, text.substr(begin, end - begin), lines_.size() + 1));
    keys_.insert(lines_.back()["key"].get<std::string>());
  }
  const std::ofstream file(path_, std::ios::app);  // makes it
  std::error_code failure;
  std::filesystem::resize_file(path_, text.size(), failure);
  if (!file || failure) throw Error(ErrorKind::output, fmt::format("\"{}\" cannot be written", path_));
}

void ResultsFile::add(const std::string& key, Json line) {
  line["key"] = key;
  std::ofstream file(path_, std::ios::app);
  file << line.dump(-1, ' ', false, Json::error_handler_t::replace) << '\n' << std::flush;
  if (!file) throw Error(ErrorKind::output, fmt::format("\"{}\" cannot be written; is the disk full?", path_));
  keys_.insert(key);
  lines_.push_back(std::move(line));
}

}  // namespace rpf::bench
