// Results as JSON lines: one object a measurement, appended as soon as it is made, so that a stopped sweep goes on.
#pragma once

#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <vector>

namespace rpf::bench {

class ResultsFile {
 public:
  /// Reads what is there: lines whose objects have `first_key`, the key that a line begins with, and a text "key". A
  /// last line without its end, which a killed run leaves, is cut off; it is behind others or begins with `first_key`.
  /// Throws Error(input) for any other file, which stays as it is, Error(output) where the file cannot be written or is
  /// none.
  ResultsFile(std::string path, const std::string& first_key);

  bool has(const std::string& key) const { return keys_.count(key) > 0; }
  const std::vector<nlohmann::ordered_json>& lines() const { return lines_; }

  /// Appends a line; it is in the file when this returns. Throws Error(output).
  void add(const std::string& key, nlohmann::ordered_json line);

 private:
  std::string path_;
  std::set<std::string> keys_;
  std::vector<nlohmann::ordered_json> lines_;
};

}  // namespace rpf::bench
