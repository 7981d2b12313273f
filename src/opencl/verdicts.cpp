#include "opencl/verdicts.h"

#include <fmt/format.h>

#include <chrono>
#include <system_error>

#include "opencl/cache_file.h"

namespace rpf {
namespace {

namespace fs = std::filesystem;

constexpr auto good_for = std::chrono::hours(7 * 24), bad_for = std::chrono::hours(1);
const std::string works = "works\n", fails = "fails\n";

bool is_failure(const std::string& text) { return text.compare(0, fails.size(), fails) == 0; }

/// Negative for a file of the future: a clock was set back.
fs::file_time_type::duration age_of(const fs::path& file) {
  std::error_code failed;
  const auto written = fs::last_write_time(file, failed);
  return failed ? good_for : fs::file_time_type::clock::now() - written;
}

}  // namespace

fs::path Verdicts::file_of(const std::string& question) const {
  return folder_ / fmt::format("{:016x}", checksum(question));
}

std::optional<Verdict> Verdicts::find(const std::string& question) const {
  if (folder_.empty()) return std::nullopt;
  const fs::path path = file_of(question);
  const std::string text = content_of(path);
  const bool good = text == works;
  if (!good && !is_failure(text)) return std::nullopt;  // no file, or a damaged one
  const auto age = age_of(path);
  if (age < age.zero() || age > (good ? good_for : bad_for)) return std::nullopt;
  return Verdict{good, good ? "" : text.substr(fails.size())};
}

void Verdicts::keep(const std::string& question, const Verdict& verdict) const {
  if (folder_.empty()) return;
  remove_old();
  replace_file(file_of(question), verdict.works ? works : fails + verdict.reason);
}

void Verdicts::forget(const std::string& question) const {
  std::error_code failed;
  if (!folder_.empty()) fs::remove(file_of(question), failed);
}

void Verdicts::forget_failures() const {
  remove_if([](const fs::path& file) { return is_failure(content_of(file)); });
}

void Verdicts::remove_old() const {
  remove_if([](const fs::path& file) { return age_of(file) > good_for; });
}

void Verdicts::remove_if(const std::function<bool(const fs::path&)>& unwanted) const {
  std::error_code failed;
  for (fs::directory_iterator entry(folder_, failed), end; !failed && entry != end; entry.increment(failed)) {
    std::error_code gone;  // another process cleans too
    if (unwanted(entry->path())) fs::remove(entry->path(), gone);
  }
}

}  // namespace rpf
