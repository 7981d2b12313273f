#include "cli/frame_part.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdlib>
#include <regex>

#include "cli/filter_options.h"
#include "cli/origin.h"
#include "rpf/error.h"
#include "rpf/io.h"

namespace rpf::cli {
namespace {

constexpr const char *rows_attribute = "rpf:rows", *frame_attribute = "rpf:frameWindow";

/// A file with the rows that it holds.
struct Part {
  std::string path;
  Image image;
  Window frame;  ///< as the file says

  int first() const { return image.data_window.y; }
  int end() const { return image.data_window.y + image.data_window.height; }
};

std::string text_in(const Image& image, const char* attribute) {
  const auto found = image.metadata.find(attribute);
  const std::string* text = found == image.metadata.end() ? nullptr : std::get_if<std::string>(&found->second);
  return text == nullptr ? "" : *text;
}

std::string rows_text(const Window& part) { return fmt::format("{}-{}", part.y, part.y + part.height - 1); }

[[noreturn]] void refuse(const std::string& what) { throw Error(ErrorKind::input, "join: " + what); }

/// Rows 540-809 of a frame as far as one process has to know of the others.
void check_same(const Part& first, const Part& part) {
  for (const auto& [attribute, what] : {std::pair{input_attribute, "another input"},
                                        {settings_attribute, "the same input with other settings"},
                                        {frame_attribute, "a frame of another data window"}})
    if (text_in(first.image, attribute) != text_in(part.image, attribute))
      refuse(fmt::format("\"{}\" was made of {} than \"{}\"; join parts of one frame, all filtered alike", part.path,
                         what, first.path));
  if (first.image.channels != part.image.channels)
    refuse(fmt::format("\"{}\" has the channels {}, \"{}\" has {}; join images of one kind", part.path,
                       fmt::join(part.image.channels, ", "), first.path, fmt::join(first.image.channels, ", ")));
}

/// Whether the rows follow each other from the frame's first to its last.
void check_rows(const std::vector<Part>& parts, const Window& frame) {
  std::vector<std::string> missing;
  int next = frame.y;
  const auto expect = [&](int row) {
    if (next < row) missing.push_back(rows_text({0, next, 0, row - next}));
  };
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (parts[i].first() < next)
      refuse(fmt::format("\"{}\" and \"{}\" both hold row {}; leave one of them out", parts[i - 1].path, parts[i].path,
                         parts[i].first()));
    expect(parts[i].first());
    next = parts[i].end();
  }
  expect(frame.y + frame.height);
  if (!missing.empty())
    refuse(fmt::format("rows {} are missing; filter them with --rows and join all parts", fmt::join(missing, ", ")));
}

/// No pixels where the file does not say which.
Window frame_of(const Image& image) {
  try {
    return window_of(frame_attribute, text_in(image, frame_attribute));
  } catch (const Error&) {
    return {};
  }
}

Part read_part(const std::string& path) {
  Part part{path, read_image(path), {}};
  const Window& window = part.image.data_window;
  part.frame = frame_of(part.image);
  if (text_in(part.image, rows_attribute) != rows_text(window) || part.frame.x != window.x ||
      part.frame.width != window.width)
    refuse(fmt::format("\"{}\" is no part of a frame; join what rpf --rows writes, as .exr", path));
  return part;
}

}  // namespace

Window rows_of(const std::string& text, const Window& data_window) {
  static const std::regex range(R"((-?\d{1,9})-(-?\d{1,9}))"), part(R"((\d{1,6})/(\d{1,6}))");
  std::smatch numbers;
  const auto number = [&](std::size_t i) { return std::atoi(numbers[i].str().c_str()); };
  Window rows = data_window;
  if (std::regex_match(text, numbers, range)) {
    rows.y = number(1);
    rows.height = number(2) - number(1) + 1;
  } else if (std::regex_match(text, numbers, part) && number(1) > 0 && number(1) <= number(2)) {
    const auto begin = [&](int i) { return static_cast<int>(std::int64_t{data_window.height} * i / number(2)); };
    rows.y += begin(number(1) - 1);
    rows.height = begin(number(1)) - begin(number(1) - 1);
  } else {
    rows.height = 0;
  }
  const bool inside =
      rows.height > 0 && rows.y >= data_window.y && rows.y + rows.height <= data_window.y + data_window.height;
  if (!inside)
    throw Error(ErrorKind::usage,
                fmt::format("--rows {}: rows of {}, such as {}, or a part of them that has rows, such "
                            "as 2/4, are expected",
                            text.substr(0, 40), text_of(data_window), rows_text(data_window)));
  return rows;
}

void mark_part(Image& image, const Window& data_window) {
  image.metadata[rows_attribute] = rows_text(image.data_window);
  image.metadata[frame_attribute] = text_of(data_window);
}

bool is_part(const Image& image, const Window& part, const Window& data_window) {
  return text_in(image, rows_attribute) == rows_text(part) && text_in(image, frame_attribute) == text_of(data_window);
}

Image joined(const std::vector<std::string>& paths) {
  std::vector<Part> parts;
  for (const std::string& path : paths) parts.push_back(read_part(path));
  std::stable_sort(parts.begin(), parts.end(), [](const Part& a, const Part& b) { return a.first() < b.first(); });
  for (const Part& part : parts) check_same(parts.front(), part);
  Image whole = std::move(parts.front().image);
  const Window frame = parts.front().frame;
  parts.front().image.data_window = whole.data_window;
  check_rows(parts, frame);
  std::size_t values = whole.pixels.size();
  for (const Part& part : parts) values += part.image.pixels.size();
  whole.pixels.reserve(values);  // the parts' memory once more, not twice
  for (std::size_t i = 1; i < parts.size(); ++i) {
    std::vector<float>& pixels = parts[i].image.pixels;
    whole.pixels.insert(whole.pixels.end(), pixels.begin(), pixels.end());
    pixels = {};
  }
  whole.data_window = frame;
  whole.metadata.erase(rows_attribute);
  whole.metadata.erase(frame_attribute);
  return whole;
}

}  // namespace rpf::cli
