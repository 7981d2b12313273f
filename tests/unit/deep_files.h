// Makes sample buffers, and sample files of every kind that OpenEXR can write, good and bad.
#pragma once

#include <ImfChannelList.h>
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineOutputFile.h>
#include <ImfHeader.h>
#include <ImfPartType.h>
#include <ImfStringAttribute.h>
#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "rpf/error.h"
#include "rpf/io.h"

namespace deep_files {

using Counts = std::function<unsigned(int pixel)>;

inline const std::vector<std::string> basic_slots = {"B", "G", "R", "film.X", "film.Y", "random.lens.U"};

inline Imath::Box2i box(const rpf::Window& w) {
  return {Imath::V2i(w.x, w.y), Imath::V2i(w.x + w.width - 1, w.y + w.height - 1)};
}

/// What a deep file is to be; the value of channel c of sample s is value(c, s).
struct Recipe {
  rpf::Window data_window{0, 0, 4, 3};
  Imf::Compression compression = Imf::ZIPS_COMPRESSION;
  Imf::LineOrder line_order = Imf::INCREASING_Y;
  std::vector<std::string> channels = basic_slots;
  std::vector<Imf::PixelType> types;  ///< FLOAT where it is too short
  Counts counts = [](int) { return 2U; };
  std::string marker = "mc-samples";  ///< empty: no attribute

  Imf::PixelType type(std::size_t c) const { return c < types.size() ? types[c] : Imf::FLOAT; }
};

/// Survives half: a multiple of 1/4 below 512.
inline float value(std::size_t channel, std::size_t sample) {
  return static_cast<float>((channel * 37 + sample * 5) % 2048) * 0.25F;
}

inline Imf::Header header_of(const Recipe& recipe) {
  Imf::Header header(box(recipe.data_window), box(recipe.data_window));
  header.setType(Imf::DEEPSCANLINE);
  header.compression() = recipe.compression;
  header.lineOrder() = recipe.line_order;
  for (std::size_t c = 0; c < recipe.channels.size(); ++c)
    header.channels().insert(recipe.channels[c], Imf::Channel(recipe.type(c)));
  if (!recipe.marker.empty()) header.insert("rpf:format", Imf::StringAttribute(recipe.marker));
  return header;
}

/// Writes the whole frame from flat arrays, as a renderer would, independent of the library's row by row writer.
inline void write_deep(const std::string& path, const Recipe& recipe) {
  const std::size_t pixels = recipe.data_window.pixel_count();
  const auto width = static_cast<std::size_t>(recipe.data_window.width);
  std::vector<unsigned> counts(pixels);
  std::vector<std::size_t> first(pixels + 1, 0);
  for (std::size_t p = 0; p < pixels; ++p) {
    counts[p] = recipe.counts(static_cast<int>(p));
    first[p + 1] = first[p] + counts[p];
  }
  const auto origin = static_cast<std::ptrdiff_t>(recipe.data_window.x) +
                      static_cast<std::ptrdiff_t>(recipe.data_window.y) * static_cast<std::ptrdiff_t>(width);
  const auto shifted = [&](auto* data) {
    return reinterpret_cast<char*>(reinterpret_cast<std::intptr_t>(data) -
                                   origin * static_cast<std::ptrdiff_t>(sizeof(*data)));
  };
  Imf::DeepFrameBuffer frame;
  frame.insertSampleCountSlice(Imf::Slice(Imf::UINT, shifted(counts.data()), 4, 4 * width));
  std::vector<std::vector<char>> values(recipe.channels.size());
  std::vector<std::vector<char*>> pointers(recipe.channels.size(), std::vector<char*>(pixels));
  for (std::size_t c = 0; c < recipe.channels.size(); ++c) {
    const std::size_t size = recipe.type(c) == Imf::HALF ? 2 : 4;
    values[c].resize(first[pixels] * size + 1);
    for (std::size_t s = 0; s < first[pixels]; ++s) {
      const float number = value(c, s);
      const half small(number);
      const auto integer = static_cast<unsigned>(number);
      const void* source = &number;
      if (recipe.type(c) == Imf::HALF) source = &small;
      if (recipe.type(c) == Imf::UINT) source = &integer;
      std::memcpy(values[c].data() + s * size, source, size);
    }
    for (std::size_t p = 0; p < pixels; ++p) pointers[c][p] = values[c].data() + first[p] * size;
    frame.insert(recipe.channels[c], Imf::DeepSlice(recipe.type(c), shifted(pointers[c].data()), sizeof(char*),
                                                    sizeof(char*) * width, size));
  }
  Imf::DeepScanLineOutputFile file(path.c_str(), header_of(recipe), 0);
  file.setFrameBuffer(frame);
  file.writePixels(recipe.data_window.height);
}

/// A buffer with the layout of `slots` and values that no type but float can hold, NaN and infinities among them.
inline rpf::SampleBuffer make_buffer(const rpf::Window& window, const Counts& counts) {
  rpf::SampleBuffer samples;
  samples.data_window = samples.display_window = window;
  samples.layout.slots = {"R",           "G",           "B",          "film.X", "film.Y", "random.lens.U",
                          "random.time", "feature.N.X", "feature.hit"};
  samples.first_sample.push_back(0);
  for (std::size_t p = 0; p < window.pixel_count(); ++p)
    samples.first_sample.push_back(samples.first_sample.back() + counts(static_cast<int>(p)));
  for (std::size_t i = 0; i < samples.sample_count() * samples.layout.size(); ++i)
    samples.values.push_back(0.1F * static_cast<float>(i) - 3.0F);
  for (std::size_t i = 0; i < samples.values.size(); i += 17) samples.values[i] = i % 2 == 0 ? -1e38F : 1e-42F;
  for (std::size_t i = 5; i < samples.values.size(); i += 23)
    samples.values[i] = i % 2 == 0 ? std::numeric_limits<float>::quiet_NaN() : std::numeric_limits<float>::infinity();
  return samples;
}

/// The error that `work` must throw, as "<kind> <text>".
inline std::string error_of(const std::function<void()>& work) {
  try {
    work();
  } catch (const rpf::Error& error) {
    return std::to_string(static_cast<int>(error.kind())) + " " + error.what();
  }
  ADD_FAILURE() << "nothing was thrown";
  return "";
}

/// `text` is an error of `kind` and has all the words.
inline void expect_error(const std::string& text, rpf::ErrorKind kind, const std::vector<std::string>& words) {
  EXPECT_EQ(text.substr(0, text.find(' ')), std::to_string(static_cast<int>(kind))) << text;
  for (const std::string& word : words) EXPECT_NE(text.find(word), std::string::npos) << word << " is not in: " << text;
}

}  // namespace deep_files
