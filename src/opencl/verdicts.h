// What was found out about drivers, remembered between runs.
#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <string>

namespace rpf {

/// Whether a driver did what it was asked, and if not, what happened.
struct Verdict {
  bool works = false;
  std::string reason;
};

/// Verdicts by question, a file each. A good one holds for a week, a bad one for an hour: machines are repaired.
class Verdicts {
 public:
  /// An empty folder, or one that cannot be written, remembers nothing.
  explicit Verdicts(std::filesystem::path folder) : folder_(std::move(folder)) {}

  std::optional<Verdict> find(const std::string& question) const;
  void keep(const std::string& question, const Verdict& verdict) const;
  void forget(const std::string& question) const;
  void forget_failures() const;

 private:
  std::filesystem::path file_of(const std::string& question) const;
  void remove_old() const;
  void remove_if(const std::function<bool(const std::filesystem::path&)>& unwanted) const;

  std::filesystem::path folder_;
};

}  // namespace rpf
