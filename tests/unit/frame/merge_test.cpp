// Joining renderings of one frame.
#include <gtest/gtest.h>

#include "deep_files.h"
#include "io/row_pieces.h"
#include "rpf/filter.h"
#include "rpf/rows.h"
#include "same_bits.h"
#include "temporary_folder.h"
#include "test_frames.h"

namespace rpf {
namespace {

using deep_files::error_of;
using deep_files::expect_error;
using rpf::test::same_bits;
using test::defocused_edge;

SampleBuffer frame(std::uint32_t seed, int samples = 2) {
  test::FrameOptions options;
  options.seed = seed;
  options.samples = samples;
  SampleBuffer buffer = defocused_edge(options);
  buffer.metadata["rpf:seed"] = static_cast<std::int32_t>(seed);
  return buffer;
}

/// Every second sample of each pixel, from `begin` on.
SampleBuffer half_of(const SampleBuffer& whole, std::uint32_t begin) {
  SampleBuffer half = whole;
  half.first_sample = {0};
  half.values.clear();
  for (std::size_t p = 0; p < whole.data_window.pixel_count(); ++p) {
    for (std::uint32_t s = whole.first_sample[p] + begin; s < whole.first_sample[p + 1]; s += 2)
      half.values.insert(half.values.end(), whole.record(s), whole.record(s) + whole.layout.size());
    half.first_sample.push_back(static_cast<std::uint32_t>(half.values.size() / whole.layout.size()));
  }
  return half;
}

std::unique_ptr<SampleRows> merged_rows(const std::vector<const SampleBuffer*>& buffers) {
  std::vector<RowsPart> parts;
  for (const SampleBuffer* buffer : buffers)
    parts.push_back(
        {std::string(1, static_cast<char>('a' + parts.size())) + ".exr", std::make_unique<io::BufferRows>(*buffer)});
  return merge_rows(std::move(parts));
}

/// Of both ways to merge, which refuse the same.
std::string merge_error(const SampleBuffer& a, const SampleBuffer& b) {
  const std::string error = error_of([&] { merge_samples({{"a.exr", a}, {"b.exr", b}}); });
  EXPECT_EQ(error_of([&] { merged_rows({&a, &b}); }), error);
  return error;
}

TEST(Merge, KeepsEverySampleOfTheFirstThenOfTheSecond) {
  const SampleBuffer a = frame(1, 0), b = frame(2, 3);  // varying counts, none in some pixels
  const SampleBuffer merged = merge_samples({{"a", a}, {"b", b}});
  ASSERT_EQ(merged.sample_count(), a.sample_count() + b.sample_count());
  merged.validate();
  for (std::size_t p = 0; p < a.data_window.pixel_count(); ++p) {
    std::size_t next = merged.first_sample[p];
    for (const SampleBuffer* part : {&a, &b})
      for (std::size_t s = part->first_sample[p]; s < part->first_sample[p + 1]; ++s, ++next)
        ASSERT_EQ(std::memcmp(merged.record(next), part->record(s), a.layout.size() * sizeof(float)), 0);
    ASSERT_EQ(next, merged.first_sample[p + 1]);
  }
}

TEST(Merge, RefusesAnotherCamera) {
  const SampleBuffer a = frame(1, 0);
  for (const auto& [name, value] : Metadata{{"view", std::string("left")},
                                            {"rpf:worldOrigin", std::vector<float>{1, 2, 3}},
                                            {"worldToNDC", std::vector<float>(16, 0.5F)}}) {
    SampleBuffer named = a, other = frame(2, 3);
    named.metadata[name] = other.metadata[name] = value;
    EXPECT_NO_THROW(merge_samples({{"a.exr", named}, {"b.exr", other}})) << name;
    other.metadata[name] = value.index() == 2 ? Attribute("right") : Attribute(std::vector<float>(3, 9.0F));
    EXPECT_NE(merge_error(named, other).find("\"b.exr\" has another " + name), std::string::npos);
  }
  SampleBuffer moved = frame(2, 3);
  moved.metadata["rpf:worldOrigin"] = std::vector<float>{1, 2, 3};
  EXPECT_NE(merge_error(a, moved), "");  // no origin is 0
  moved.metadata["rpf:worldOrigin"] = std::vector<float>(3, 0.0F);
  EXPECT_NO_THROW(merge_samples({{"a.exr", a}, {"b.exr", moved}}));
}

TEST(Merge, RowByRowMakesTheSame) {
  const SampleBuffer a = frame(1, 0), b = frame(2, 3);
  SampleBuffer c = frame(3, 1);
  std::swap(c.layout.slots[0], c.layout.slots[6]);  // another order
  const SampleBuffer whole = merge_samples({{"a", a}, {"b", b}, {"c", c}});
  const std::unique_ptr<SampleRows> rows = merged_rows({&a, &b, &c});
  EXPECT_EQ(rows->frame().metadata, whole.metadata);
  EXPECT_EQ(rows->frame().layout.slots, whole.layout.slots);
  EXPECT_EQ(rows->sample_count(), whole.sample_count());
  io::BufferRows expected(whole);
  for (const auto& [first, end] : {std::pair{0, 9}, std::pair{8, 9}, std::pair{2, 5}}) {
    EXPECT_EQ(rows->row_samples(first), expected.row_samples(first));
    const SampleBuffer found = rows->read(first, end), wanted = expected.read(first, end);
    EXPECT_EQ(found.first_sample, wanted.first_sample);
    EXPECT_TRUE(same_bits(found.values, wanted.values));
    EXPECT_EQ(found.data_window, wanted.data_window);
  }
}

TEST(Merge, KeepsNaNInfinityAndMinusZero) {
  const auto one = [](int) { return 1U; };
  const SampleBuffer a = deep_files::make_buffer({-3, 2, 4, 3}, one);
  SampleBuffer b = a;
  for (float& value : b.values) value = -value;
  const SampleBuffer merged = merge_samples({{"a", a}, {"b", b}});
  EXPECT_TRUE(same_bits(half_of(merged, 0).values, a.values));
  EXPECT_TRUE(same_bits(half_of(merged, 1).values, b.values));
}

TEST(Merge, FilteringTwoHalvesIsFilteringTheWhole) {
  // The whole with the samples of the first half in front of those of the second, as a merge orders them.
  const SampleBuffer whole = frame(3, 4);
  const SampleBuffer merged = merge_samples({{"a", half_of(whole, 0)}, {"b", half_of(whole, 1)}});
  SampleBuffer by_hand = whole;
  for (std::size_t p = 0; p < whole.data_window.pixel_count(); ++p)
    for (std::size_t i = 0; i < 4; ++i)
      std::copy_n(whole.record(4 * p + (2 * i % 4 + i / 2)), whole.layout.size(), by_hand.record(4 * p + i));
  ASSERT_TRUE(same_bits(merged.values, by_hand.values));
  EXPECT_TRUE(same_bits(filter(merged, test::small_settings()).image.pixels,
                        filter(by_hand, test::small_settings()).image.pixels));
}

TEST(Merge, OrdersTheSlotsAsTheFirstDoes) {
  const SampleBuffer a = frame(1);
  SampleBuffer b = frame(2);
  std::swap(b.layout.slots[0], b.layout.slots[6]);
  for (std::size_t s = 0; s < b.sample_count(); ++s) std::swap(b.record(s)[0], b.record(s)[6]);
  EXPECT_TRUE(same_bits(merge_samples({{"a", a}, {"b", b}}).values, merge_samples({{"a", a}, {"b", frame(2)}}).values));
}

TEST(Merge, ListsTheSeedsAndKeepsTheFirstsMetadata) {
  SampleBuffer a = frame(1), b = frame(2), c = frame(3);
  a.metadata["rpf:renderer"] = std::string("first");
  b.metadata["rpf:renderer"] = std::string("second");
  c.metadata.erase("rpf:seed");
  const SampleBuffer ab = merge_samples({{"a", a}, {"b", b}});
  EXPECT_EQ(ab.metadata.at("rpf:seeds"), Attribute(std::string("1 2")));
  EXPECT_EQ(ab.metadata.count("rpf:seed"), 0U);
  EXPECT_EQ(ab.metadata.at("rpf:renderer"), Attribute(std::string("first")));
  EXPECT_EQ(merge_samples({{"ab", ab}, {"c", c}}).metadata.at("rpf:seeds"), Attribute(std::string("1 2 ?")));
  EXPECT_EQ(merge_samples({{"a", a}}).metadata, a.metadata);
}

TEST(Merge, RefusesFramesThatDiffer) {
  SampleBuffer other = frame(2);
  other.data_window.x = -5;
  expect_error(merge_error(frame(1), other), ErrorKind::input, {"\"b.exr\"", "13x9-5+0", "\"a.exr\"", "13x9+0+0"});
  SampleBuffer more = frame(2);
  test::add_channel(more, "feature.depth", 1);
  for (const std::string& error : {merge_error(frame(1), more), merge_error(more, frame(1))})
    expect_error(error, ErrorKind::input, {"feature.depth", "--map feature.depth="});
  expect_error(merge_error(frame(1), more), ErrorKind::input, {"\"a.exr\" has no slot"});
  EXPECT_THROW(merge_samples({}), Error);
  EXPECT_THROW(merge_rows({}), Error);
}

TEST(Merge, RefusesTheSameSamplesTwice) {
  const SampleBuffer a = frame(7), b = frame(8);
  expect_error(merge_error(a, a), ErrorKind::input, {R"("b.exr" repeats samples of "a.exr")", "7 and 7", "seed"});
  // Also as a part of a merge, whichever comes first, and where a longer rendering begins like a shorter one.
  const SampleBuffer both = merge_samples({{"a", a}, {"b", b}});
  for (const SampleBuffer* part : {&a, &b}) {
    expect_error(merge_error(both, *part), ErrorKind::input, {"repeats"});
    expect_error(merge_error(*part, both), ErrorKind::input, {"repeats"});
  }
  SampleBuffer turned = a;  // in another order of slots
  std::swap(turned.layout.slots[0], turned.layout.slots[6]);
  for (std::size_t i = 0; i < a.sample_count(); ++i) std::swap(turned.record(i)[0], turned.record(i)[6]);
  expect_error(merge_error(a, turned), ErrorKind::input, {"repeats"});
  // One sample in common is chance, no samples at all are harmless.
  SampleBuffer once = b;
  std::copy_n(a.record(0), a.layout.size(), once.record(0));
  EXPECT_EQ(merge_samples({{"a", a}, {"once", once}}).sample_count(), 2 * a.sample_count());
  const SampleBuffer empty = deep_files::make_buffer({0, 0, 3, 3}, [](int) { return 0U; });
  EXPECT_EQ(merge_samples({{"a", empty}, {"b", empty}}).sample_count(), 0U);
}

TEST(Merge, PredictsItsMemory) {
  const std::uint64_t values = 2 * 1000 * 20 * 4, offsets = 4 * (100 + 1) * 4;
  EXPECT_EQ(merging_bytes(100, 1000, 20, 2), values + offsets);
}

}  // namespace
}  // namespace rpf
