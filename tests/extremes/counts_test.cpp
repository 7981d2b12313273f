// Sizes of frames and numbers of samples (docs/stability.md, "Counts and shapes").
#include <algorithm>
#include <cmath>

#include "arbitrary.h"
#include "io/reading.h"
#include "plan/plan.h"
#include "rpf/error.h"
#include "tolerances.h"

namespace rpf {
namespace {

using namespace test;

/// Puts a copy of a sample behind it, in the same pixel.
void double_sample(SampleBuffer& samples, std::uint32_t sample) {
  const std::vector<float> copy(samples.record(sample), samples.record(sample) + samples.layout.size());
  samples.values.insert(samples.values.begin() + static_cast<std::ptrdiff_t>(sample * copy.size()), copy.begin(),
                        copy.end());
  for (auto p = static_cast<std::size_t>(pixel_of(samples, sample)) + 1; p < samples.first_sample.size(); ++p)
    ++samples.first_sample[p];
}

/// Takes all samples of some pixels away.
void empty_pixels(SampleBuffer& samples, int first, int count) {
  for (int pixel = first; pixel < first + count; ++pixel)
    while (samples.first_sample[static_cast<std::size_t>(pixel)] !=
           samples.first_sample[static_cast<std::size_t>(pixel) + 1])
      samples = without(samples, samples.first_sample[static_cast<std::size_t>(pixel)]);
}

/// Root mean square of the differences.
double rms(const std::vector<float>& a, const std::vector<float>& b) {
  double sum = 0;
  for (std::size_t i = 0; i < a.size(); ++i) sum += std::pow(static_cast<double>(a[i]) - b[i], 2);
  return std::sqrt(sum / static_cast<double>(a.size()));
}

RC_GTEST_PROP(Size, OfAnyFrameAlsoSmallerThanTheBoxStaysInsideTheHull, ()) {
  const int width = *rc::gen::element(1, 1, 2, 3, 5, 17), height = *rc::gen::element(1, 1, 2, 3, 5, 17);
  const int samples = *rc::gen::element(1, 4);
  const SampleBuffer frame =
      defocused_edge({width, height, samples, static_cast<std::uint32_t>(*rc::gen::inRange(0, 1 << 30))});
  Settings settings = settings_of(Profile::thesis);
  settings.features = std::vector<std::string>{"P"};
  settings.random = std::vector<std::string>{"lens"};
  RC_ASSERT(outside_hull(filtered(frame, settings), frame) == "");
}

RC_GTEST_PROP(Counts, ThatVaryElsewhereChangeNothingHere, ()) {
  const SampleBuffer uniform = any_uniform_frame();
  const Settings settings = any_settings();
  SampleBuffer varying = uniform;
  const std::uint32_t sample = any_sample(uniform);
  double_sample(varying, sample);
  RC_ASSERT(difference_beyond_reach(filtered(varying, settings), filtered(uniform, settings), 24,
                                    pixel_of(uniform, sample)) == "");
}

RC_GTEST_PROP(Counts, OfZeroAreBlackToldAndHarmless, ()) {
  const SampleBuffer full = any_uniform_frame();
  const Settings settings = any_settings();
  const int first = *rc::gen::inRange(0, 24 * 16 - 24),
            count = *rc::gen::element(1, 24);  // a pixel, or as many as a row
  SampleBuffer samples = full;
  empty_pixels(samples, first, count);
  const Result result = run(samples, settings);
  RC_ASSERT(result.report.notes.size() == 1U);
  RC_ASSERT(result.report.notes[0].count == static_cast<std::uint64_t>(count));
  RC_ASSERT(result.report.notes[0].y * 24 + result.report.notes[0].x == first);
  RC_ASSERT(not_finite(result.image.pixels) == "");
  for (int i = 3 * first; i < 3 * (first + count); ++i)
    RC_ASSERT(result.image.pixels[static_cast<std::size_t>(i)] == 0.0F);
}

// Draws name samples by their place in the pixel, sums are taken in that order. So nothing is exact but what does not
// depend on either: the number of neighbors.
RC_GTEST_PROP(Order, OfTheSamplesInAPixelMattersOnlyByRoundingWhereNothingIsDrawn, ()) {
  SampleBuffer samples = any_uniform_frame();
  Settings settings = settings_of(Profile::thesis);
  settings.box_widths = {1, 1};
  const Result before = run(samples, settings);
  for (std::uint32_t first = 0; first < samples.sample_count(); first += 4) {
    const int turn = *rc::gen::inRange(0, 4);
    float* pixel = samples.record(first);
    const auto stride = static_cast<std::ptrdiff_t>(samples.layout.size());
    std::rotate(pixel, pixel + turn * stride, pixel + 4 * stride);
  }
  const Result after = run(samples, settings);
  RC_ASSERT(after.report.passes[0].neighbors == before.report.passes[0].neighbors);
  for (std::size_t i = 0; i < before.image.pixels.size(); ++i)
    RC_ASSERT(std::fabs(after.image.pixels[i] - before.image.pixels[i]) <= tolerance::picture * before.image.pixels[i]);
}

RC_GTEST_PROP(Order, OfTheSamplesInAPixelMattersNoMoreThanAnotherSeed, ()) {
  SampleBuffer samples = any_uniform_frame();
  Settings settings = any_settings();
  const std::vector<float> before = filtered(samples, settings);
  const auto stride = static_cast<std::ptrdiff_t>(samples.layout.size());
  for (std::uint32_t first = 0; first < samples.sample_count(); first += 4)
    std::rotate(samples.record(first), samples.record(first) + stride, samples.record(first) + 4 * stride);
  const std::vector<float> turned = filtered(samples, settings);
  settings.seed += 1;
  RC_ASSERT(rms(turned, before) <= 1.5 * rms(filtered(samples, settings), before));
}

TEST(Counts, OfAThousandStayInsideTheHull) {
  const SampleBuffer samples = defocused_edge({3, 2, 1000, 1});
  Settings settings = small_settings();
  settings.box_widths = {3};
  EXPECT_EQ(outside_hull(filtered(samples, settings), samples), "");
}

TEST(Counts, BeyondTheLimitsAreRefused) {
  EXPECT_NO_THROW(io::check_sample_count("a.exr", 0xFFFFFFFEU));
  EXPECT_THROW(io::check_sample_count("a.exr", 0xFFFFFFFFU), Error);
  FrameFacts facts;
  facts.width = facts.height = 1;
  facts.crop = {0, 0, 1, 1};
  facts.max_samples_per_pixel = (1U << 24) + 1;
  EXPECT_THROW(make_plan(facts, small_settings()), Error);
}

// sigma^2 is 8 sigma_8^2 / s (T 5.10): the filter fades out.
TEST(Consistency, ThePictureTendsToThePlainMeanAsSamplesGrow) {
  for (const Profile profile : {Profile::thesis, Profile::paper}) {
    std::vector<double> distance;
    for (const int samples : {4, 32, 512}) {
      const SampleBuffer frame = defocused_edge({8, 6, samples, 1});
      Settings settings = small_settings();
      settings.profile = profile;
      settings.box_widths.clear();
      const std::vector<float> mean = filtered(frame, settings);
      settings.box_widths = {3};
      distance.push_back(rms(filtered(frame, settings), mean));
    }
    EXPECT_LT(distance[1], distance[0]);
    EXPECT_LT(distance[2], distance[1]);
  }
}

}  // namespace
}  // namespace rpf
