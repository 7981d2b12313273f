// What the filter thinks of a frame, pixel by pixel: layers to look at, and everything about one pixel.
// docs/explain.md says what each value means, and how far it can be trusted.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rpf/filter.h"
#include "rpf/image.h"
#include "rpf/samples.h"
#include "rpf/settings.h"

namespace rpf {

/// A pixel in the coordinates of the data window.
struct PixelPosition {
  int x = 0, y = 0;
};

/// A sample of a pixel's neighborhood.
struct ExplainedNeighbor {
  PixelPosition pixel;         ///< that it belongs to
  std::array<float, 3> color;  ///< radiance
  std::uint32_t drawn = 0;     ///< how often it is in the neighborhood
  float share = 0;             ///< of the pixel's filtered value; all neighbors together have 1
};

/// What two variables have in common in the neighborhood.
struct ExplainedPair {
  std::string first, second;             ///< "R", "lens.U"
  std::vector<std::uint32_t> histogram;  ///< [bin of first][bin of second]
  float information = 0;                 ///< nats
};

/// Section 5 of docs/algorithm.md for a feature.
struct ExplainedFeature {
  std::string name;                      ///< "N.X"
  float on_random = 0, on_position = 0;  ///< D_f,k^r, D_f,k^p; nats
  float fraction_random = 0;             ///< W_f,k^r
  float color_on_feature = 0;            ///< D_c^{f,k}; nats
  float fraction_feature = 0;            ///< W_c^{f,k}
  float beta = 0;
};

/// The same for a color channel.
struct ExplainedColor {
  std::string name;                                       ///< "R"
  float on_random = 0, on_position = 0, on_features = 0;  ///< D_c,i^r, D_c,i^p, D_c,i^f; nats
  float fraction_random = 0;                              ///< W_c,i^r
  float alpha = 0;
};

/// Everything about one pixel.
struct ExplainedPixel {
  PixelPosition position;
  std::uint32_t samples = 0, drawn = 0;      ///< of its own; candidates
  std::vector<ExplainedNeighbor> neighbors;  ///< each once, by falling share
  std::size_t bins = 0;                      ///< of a histogram's side
  std::vector<ExplainedPair> pairs;
  std::vector<ExplainedColor> colors;
  std::vector<ExplainedFeature> features;
  float fraction_random = 0;  ///< W_c^r
  float effective_samples = 0;
  std::array<float, 3> mean{}, filtered{};  ///< radiance: plain mean, and after the pass
};

/// What explain() found.
struct Explanation {
  /// Over the whole data window; the channels are those of docs/explain.md: R, G, B, filtered.R, W.mean, share.lens ...
  Image layers;
  std::vector<std::string> groups;  ///< of random parameters, those of the channels share.*
  std::optional<ExplainedPixel> pixel;
  Report report;
};

/// A sample in the picture of a network.
struct Contribution {
  PixelPosition pixel;         ///< that it belongs to
  std::array<float, 3> color;  ///< radiance
  float share = 0;             ///< of the pixel explained; all of them together have 1
};

/// Which samples a pixel of a preset's picture is made of (docs/network.md): its color is `factor` times the mean of
/// theirs, weighted by their shares.
struct ExplainedEstimate {
  PixelPosition position;
  std::string model;                        ///< the network's name
  Window window;                            ///< the pixels that it can be made of, as the data window counts
  std::vector<float> shares;                ///< [pixel of the window, row by row] of all its samples
  std::vector<Contribution> samples;        ///< by falling share, without those of none
  float effective_samples = 0;              ///< so many equal shares would average as much noise away
  std::array<float, 3> factor = {1, 1, 1};  ///< the pixel's albedo over that of the samples, as far as the blend goes
  std::array<float, 3> mean{}, result{};    ///< radiance: plain mean; in the preset's picture
};

/// What explain() is to be called with where nothing is wished otherwise: one pass, of box width 21 with M = b^2 s / 2.
Settings explain_settings();

/// Runs one pass of the filter and keeps what it found. The settings must have exactly one box width, no crop, and no
/// other method than rpf. `pixel`: also everything about this one, which has samples. Throws as filter() does.
Explanation explain(SampleBuffer samples, const Settings& settings, const Control& control = {},
                    const std::optional<PixelPosition>& pixel = {});

/// The same pixel in the picture of a preset: `settings` have Method::learned. Throws as filter() does.
ExplainedEstimate explain_estimate(SampleBuffer samples, const Settings& settings, const PixelPosition& pixel,
                                   const Control& control = {});

/// Channels of Explanation::layers where none of the input's is constant: of those that are, there are no layers.
/// Throws Error(usage) for a group that the layout does not have.
std::vector<std::string> explain_layers(const SampleLayout& layout, const Settings& settings);

/// Peak bytes of reading and explaining, as predict_memory() of rpf/filter.h.
std::uint64_t predict_explain_memory(const FrameSize& size, const SampleLayout& layout, const Settings& settings);

}  // namespace rpf
