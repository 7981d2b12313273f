// The reference's layers against naive loops in double.
#include "cpu/layers.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "cpu/passes.h"
#include "rpf_network.h"
#include "test_frames.h"
#include "tolerances.h"

namespace rpf {
namespace {

using test::Dice;

Field random_field(int width, int height, std::size_t channels, Dice& dice) {
  Field field(width, height, channels);
  for (float& v : field.values) v = 2 * dice() - 1;
  return field;
}

NetworkLayer random_layer(int inputs, int outputs, int taps, Dice& dice) {
  NetworkLayer layer{"layer", inputs, outputs, taps, {}, {}};
  layer.weights.resize(static_cast<std::size_t>(inputs * outputs * taps));
  layer.bias.resize(static_cast<std::size_t>(outputs));
  for (std::vector<float>* values : {&layer.weights, &layer.bias})
    for (float& v : *values) v = 2 * dice() - 1;
  return layer;
}

/// The value of channel i of all sources at a cell, coordinates clamped.
double value_at(const std::vector<Source>& sources, int width, int height, int x, int y, int i) {
  const int cx = std::clamp(x, 0, width - 1), cy = std::clamp(y, 0, height - 1);
  for (const Source& s : sources) {
    if (i < static_cast<int>(s.field->channels)) return s.field->at(cx >> s.halvings, cy >> s.halvings)[i];
    i -= static_cast<int>(s.field->channels);
  }
  return NAN;
}

double convolved(const NetworkLayer& l, const std::vector<Source>& sources, const Field& out, int x, int y, int o) {
  double sum = l.bias[static_cast<std::size_t>(o)];
  for (int k = 0; k < 9; ++k)
    for (int i = 0; i < l.inputs; ++i)
      sum += value_at(sources, out.width, out.height, x + k % 3 - 1, y + k / 3 - 1, i) *
             l.weights[static_cast<std::size_t>((k * l.inputs + i) * l.outputs + o)];
  return sum > 0 ? sum : 0.1 * sum;
}

void expect_convolved(const NetworkLayer& layer, const std::vector<Source>& sources, Field out) {
  for (int y = 0; y < out.height; ++y) convolve_row(layer, sources, y, out);
  for (int y = 0; y < out.height; ++y)
    for (int x = 0; x < out.width; ++x)
      for (int o = 0; o < layer.outputs; ++o)
        ASSERT_NEAR(out.at(x, y)[o], convolved(layer, sources, out, x, y, o), test::tolerance::convolution)
            << x << "," << y << " output " << o;
}

TEST(Convolution, IsTheNaiveSumWhateverTheSize) {
  Dice dice(1);
  for (const int outputs : {1, 7, 8, 16, 21})
    for (const int width : {1, 2, 4, 9}) {
      const Field in = random_field(width, 5, 3, dice);
      expect_convolved(random_layer(3, outputs, 9, dice), {{&in, 0}},
                       Field(width, 5, static_cast<std::size_t>(outputs)));
    }
}

TEST(Convolution, ReadsTheLevelBelowDoubledAndThenItsOwn) {
  Dice dice(2);
  const Field below = random_field(4, 3, 5, dice), own = random_field(7, 5, 3, dice);
  expect_convolved(random_layer(8, 12, 9, dice), {{&below, 1}, {&own, 0}}, Field(7, 5, 12));
}

TEST(Dense, WithInputsLeftOutIsThatWithZeros) {
  Dice dice(3);
  const NetworkLayer layer = random_layer(10, 24, 1, dice);
  std::vector<float> x(10, 0.0F), all(24), some(24);
  for (const int i : {1, 4, 9}) x[static_cast<std::size_t>(i)] = dice();
  dense(layer, x.data(), 0, 24, all.data());
  const std::vector<float> live = {x[1], x[4], x[9]};
  dense(with_inputs(layer, {1, 4, 9}), live.data(), 0, 24, some.data());
  EXPECT_EQ(all, some);
  double expected = layer.bias[3];
  for (std::size_t i = 0; i < 10; ++i) expected += static_cast<double>(x[i]) * layer.weights[i * 24 + 3];
  EXPECT_NEAR(all[3], expected, test::tolerance::convolution);
  std::vector<float> part(5);
  dense(layer, x.data(), 7, 5, part.data());
  EXPECT_TRUE(std::equal(part.begin(), part.end(), all.begin() + 7));
}

TEST(Halving, TakesTheMeanOfTheCellsThatExist) {
  Field in(3, 3, 1), out(2, 2, 1);
  in.values = {1, 2, 3, 4, 5, 6, 7, 8, 9};
  for (int y = 0; y < 2; ++y) halve_row(in, y, out);
  EXPECT_EQ(out.values, (std::vector<float>{3, 4.5F, 7.5F, 9}));
}

/// A pass with the same loops in double, pixel by pixel.
double passed(const PassWeights& w, int dilation, const Rows& in, int x, int y, std::size_t c) {
  double sum = 0, total = 0;
  for (int j = -2; j <= 2; ++j)
    for (int i = -2; i <= 2; ++i) {
      const int ox = x + i * dilation, oy = y + j * dilation;
      if (ox < 0 || oy < 0 || ox >= in.width || oy >= in.height) continue;
      double d = 0;
      for (std::size_t k = 0; k < w.embedding.channels; ++k)
        d += std::pow(static_cast<double>(w.embedding.at(y, k)[x]) - w.embedding.at(oy, k)[ox], 2);
      const double weight = i == 0 && j == 0 ? w.own.at(y, 0)[x] : std::exp(-d);
      sum += weight * in.at(oy, c)[ox];
      total += weight;
    }
  return sum / total;
}

TEST(Pass, IsTheWeightedMeanOverTheTapsInsideTheFrame) {
  Dice dice(4);
  const auto random = [&](std::size_t channels) {
    Rows rows(11, 6, channels);
    for (float& v : rows.values) v = 2 * dice();
    return rows;
  };
  const PassWeights weights{random(5), random(1)};
  const Rows in = random(3);
  for (const int dilation : {1, 2, 8}) {
    Rows out(11, 6, 3);
    for (int y = 0; y < 6; ++y) filter_row(weights, dilation, in, y, out);
    for (int y = 0; y < 6; ++y)
      for (int x = 0; x < 11; ++x)
        for (std::size_t c = 0; c < 3; ++c)
          ASSERT_NEAR(out.at(y, c)[x], passed(weights, dilation, in, x, y, c), test::tolerance::convolution)
              << x << "," << y << " dilation " << dilation;
  }
}

}  // namespace
}  // namespace rpf
