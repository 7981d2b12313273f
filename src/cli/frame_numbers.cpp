#include "cli/frame_numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <regex>
#include <set>
#include <system_error>

#include "rpf/error.h"
#include "rpf/outputs.h"

namespace rpf::cli {
namespace {

namespace fs = std::filesystem;

constexpr int most_frames = 1000000;

[[noreturn]] void refuse(const std::string& option, const std::string& text, const std::string& expected) {
  throw Error(ErrorKind::usage, fmt::format("{} {}: {}", option, text.substr(0, 40), expected));
}

/// One part between commas: "105", "1-100", "1-100x2".
void add_range(const std::string& text, const std::string& part, std::vector<int>& frames) {
  static const std::regex pattern(R"((-?\d{1,8})(?:-(-?\d{1,8})(?:x(\d{1,8}))?)?)");
  std::smatch found;
  const bool matches = std::regex_match(part, found, pattern);
  const int first = matches ? std::stoi(found[1]) : 0, last = matches && found[2].matched ? std::stoi(found[2]) : first,
            step = matches && found[3].matched ? std::stoi(found[3]) : 1;
  if (!matches || last < first || step < 1)
    refuse("--frames", text, "numbers and rising ranges with commas are expected, such as 1-100x2,105");
  if ((last - first) / step + static_cast<int>(frames.size()) >= most_frames)
    refuse("--frames", text, fmt::format("at most {} frames are possible", most_frames));
  for (int frame = first; frame <= last; frame += step) frames.push_back(frame);
}

/// Where the number stands in a name and how many digits it has at least; size 0: nowhere.
struct Place {
  std::size_t begin = 0, size = 0, digits = 0;
};

Place place_in(const std::string& text) {
  static const std::regex pattern(R"(#+|%(?:0(\d))?d)");
  std::vector<Place> places;
  for (std::sregex_iterator at(text.begin(), text.end(), pattern), end; at != end; ++at) {
    const std::string word = at->str();
    const std::size_t digits = word[0] == '#' ? word.size() : (*at)[1].matched ? std::stoul((*at)[1]) : 1;
    places.push_back({static_cast<std::size_t>(at->position()), word.size(), digits});
  }
  if (places.size() > 1)
    throw Error(ErrorKind::usage, fmt::format("\"{}\" has {} places for the number of a frame; one is expected, as in "
                                              "in.####.exr or in.%04d.exr",
                                              text, places.size()));
  return places.empty() ? Place{} : places.front();
}

}  // namespace

std::vector<int> frame_numbers(const std::string& text) {
  std::vector<int> frames;
  for (std::size_t begin = 0; begin <= text.size();) {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    add_range(text, text.substr(begin, end - begin), frames);
    begin = end + 1;
  }
  std::set<int> seen;
  frames.erase(std::remove_if(frames.begin(), frames.end(), [&](int frame) { return !seen.insert(frame).second; }),
               frames.end());
  return frames;
}

std::vector<int> chunk_of(const std::vector<int>& frames, const std::string& text) {
  static const std::regex pattern(R"((\d{1,6})/(\d{1,6}))");
  std::smatch found;
  const bool matches = std::regex_match(text, found, pattern);
  const std::size_t part = matches ? std::stoul(found[1]) : 0, parts = matches ? std::stoul(found[2]) : 0;
  if (part < 1 || part > parts)
    refuse("--chunk", text, "PART/PARTS from 1/PARTS to PARTS/PARTS is expected, such as 2/10");
  const auto begin = static_cast<std::ptrdiff_t>((part - 1) * frames.size() / parts),
             end = static_cast<std::ptrdiff_t>(part * frames.size() / parts);
  return {frames.begin() + begin, frames.begin() + end};
}

FramePattern::FramePattern(const std::string& text) : text_(text) {
  std::error_code unknown;
  if (fs::exists(text, unknown)) return;
  const Place place = place_in(text);
  before_ = text.substr(0, place.begin), after_ = text.substr(place.begin + place.size), digits_ = place.digits;
}

std::string FramePattern::path_of(int frame) const {
  if (!has_place()) return text_;
  const std::string number = fmt::format("{:0{}}", std::abs(frame), digits_);
  return before_ + (frame < 0 ? "-" : "") + number + after_;
}

std::optional<int> FramePattern::number_in(const std::string& name) const {
  const std::string start = fs::path(before_).filename().string();
  if (name.size() <= start.size() + after_.size() || name.compare(0, start.size(), start) != 0) return {};
  const std::string digits = name.substr(start.size(), name.size() - start.size() - after_.size());
  if (digits.find_first_not_of("-0123456789") != std::string::npos || digits.size() > 8) return {};
  const int frame = std::atoi(digits.c_str());
  return fs::path(path_of(frame)).filename() == name ? std::optional<int>(frame) : std::nullopt;
}

bool FramePattern::names(const std::string& path) const {
  const auto frame = has_place() ? number_in(fs::path(path).filename().string()) : std::nullopt;
  return frame && is_same_file(path_of(*frame), path);
}

std::vector<int> FramePattern::listed() const {
  try {
    return existing();
  } catch (const Error&) {
    return {};
  }
}

std::vector<int> FramePattern::existing() const {
  const fs::path folder = fs::path(before_).parent_path();
  std::error_code failed;
  fs::directory_iterator entries(folder.empty() ? "." : folder, failed);
  if (failed)
    throw Error(ErrorKind::input, fmt::format("\"{}\": its folder cannot be read ({})", text_, failed.message()));
  std::vector<int> frames;
  for (const fs::directory_entry& entry : entries)
    if (const auto frame = number_in(entry.path().filename().string())) frames.push_back(*frame);
  std::sort(frames.begin(), frames.end());
  return frames;
}

}  // namespace rpf::cli
