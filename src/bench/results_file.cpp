#include "bench/results_file.h"

#include <fmt/format.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <system_error>

#include "rpf/error.h"
#include "rpf/outputs.h"

namespace rpf::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* refusal =
    "\"{}\", line {}: no result of rpf bench sweep or rpf study, so it stays as it is; name another file";

std::string text_of_file(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

Json parse(const std::string& path, const std::string& line, const std::string& first_key, std::size_t number) {
  Json json = Json::parse(line, nullptr, false);
  if (!json.is_object() || !json.contains(first_key) || !json.contains("key") || !json["key"].is_string())
    throw Error(ErrorKind::input, fmt::format(refusal, path, number));
  return json;
}

/// Of lines that nobody finished only those may be lost that are ours: behind others, or with their beginning.
void check_torn(const std::string& path, const std::string& text, const std::string& first_key, std::size_t whole) {
  const bool is_ours = whole > 0 || text.rfind(fmt::format("{{\"{}\":", first_key), 0) == 0;
  if (!text.empty() && !is_ours) throw Error(ErrorKind::input, fmt::format(refusal, path, whole + 1));
}

}  // namespace

ResultsFile::ResultsFile(std::string path, const std::string& first_key) : path_(std::move(path)) {
  check_target(path_);
  const std::string text = text_of_file(path_);
  std::size_t begin = 0;
  for (std::size_t end = text.find('\n'); end != std::string::npos; end = text.find('\n', begin)) {
    lines_.push_back(parse(path_, text.substr(begin, end - begin), first_key, lines_.size() + 1));
    keys_.insert(lines_.back()["key"].get<std::string>());
    begin = end + 1;
  }
  check_torn(path_, text.substr(begin), first_key, lines_.size());
  if (begin == text.size()) return;
  std::error_code failure;
  std::filesystem::resize_file(path_, begin, failure);
  if (failure) throw Error(ErrorKind::output, fmt::format("\"{}\" cannot be written", path_));
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
