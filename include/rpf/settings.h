// What a user can choose. Every option of `rpf` that changes the picture is a field here, with the same name.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "rpf/image.h"

namespace rpf {

struct Settings;

/// Throws Error(usage) for a setting that cannot be, with its option and its range.
void validate(const Settings& settings);

/// algorithm.md, sections 3 and 7.
enum class Profile {
  thesis,  ///< M = b^2 / 2 samples a neighborhood; also the position inside the pixel is a random parameter
  paper    ///< M = b^2 s / 2, and the outlier step after every pass
};

/// Where the weights of a sample's neighbors come from (algorithm.md, sections 3 to 8). Beside RPF the thesis's
/// baselines, whose weights are fixed: neighbors are all samples in the box, and none is drawn, rejected or measured;
/// the learned estimator (docs/network.md); and contemporaries of RPF that filter pixels (section 9).
enum class Method {
  rpf,              ///< from what colors and features say about the random parameters
  gaussian,         ///< from the distance on the film
  bilateral,        ///< and from the difference in color
  cross_bilateral,  ///< and from the differences in features: what RPF would be without its statistics
  learned,          ///< from a network that looks at every sample
  nlm,              ///< of pixels: from the likeness of the patches around them (Rousselle, Knaus and Zwicker 2012)
  gem,           ///< of pixels: Gaussians, each as wide as bias and variance allow (Rousselle, Knaus and Zwicker 2011)
  sbf,           ///< of pixels: cross-bilateral, each as wide as Stein's risk says (Li, Wu and Chuang 2012)
  axis_aligned,  ///< of pixels: soft shadows, as wide as their occluders allow (Mehta, Wang and Ramamoorthi 2012)
  lightfield,    ///< samples seen again from other places of the lens at other times (Lehtinen et al. 2011)
  multidim       ///< the nearest samples in the space of film, lens and time (Hachisuka et al. 2008)
};

/// What filter() is to do.
struct Settings {
  /// Methods with fixed weights know box_widths, the sigmas, features, clamp_negative and everything from
  /// filter_features on; nlm knows damping and window, gem gamma, sbf features, axis_aligned features and bandwidth,
  /// lightfield and multidim views, and these six the clamps and everything from filter_features on; learned knows
  /// model, random, features, clamp_negative and everything from filter_features on. method_settings() (rpf/methods.h)
  /// has box widths and sigmas that suit a method.
  Method method = Method::rpf;
  /// Of learned: the name of a network in the library (presets.h), or a network file.
  std::string model = "balanced";
  std::string backend = "cpu";  ///< one of backend_names()
  /// OpenCL device: index or part of a name (devices.h); empty: the first. For one that is named "auto" takes nothing
  /// else.
  std::string device;
  Profile profile = Profile::thesis;

  /// One pass per entry: odd box widths, 1 .. 255 pixels. Empty: no pass, the result is the plain mean of the samples.
  std::vector<int> box_widths = {55, 35, 17, 7};
  /// M = samples_factor * b^2 in place of the profile's M.
  std::optional<double> samples_factor;
  /// Upper limit of M; 0: none.
  std::uint32_t max_samples = 0;
  /// sigma_8^2 of (T 5.10): 0.02 for very noisy scenes, 0.002 otherwise. Above 0.
  float noise = 0.02F;
  /// Histogram bins, B = 2 K + 1: odd, 3 .. 31.
  int bins = 7;

  /// Groups of random parameters to model, for example {"lens", "time"}; "pixel" is the position inside the pixel.
  /// Nothing: lens, time and light where the file has them, with pixel in the thesis profile.
  std::optional<std::vector<std::string>> random;
  /// Groups of features to model, for example {"N", "P"}; "first" stands for all groups but those of the second hit
  /// (N2, P2, ...). Nothing: all that the file has.
  std::optional<std::vector<std::string>> features;
  /// Model none of them that carries no information (docs/deviations.md), as measured on the whole frame.
  bool drop_uninformative = false;

  std::uint32_t seed = 1;

  // The choices of algorithm.md marked [choice], and its tuning constants.
  float alpha_factor = 2.0F;       ///< the factor of (T 5.9)
  float position_scale = 20.0F;    ///< least tolerance of world positions: 0.1 * scene diagonal / this; above 0
  int redraws = 8;                 ///< further attempts of a draw that left the image, 0 .. 15
  bool reject_second_hit = false;  ///< features of the second hit (N2, P2, ...) take part in the rejection test
  bool bias_correction = false;    ///< subtract (B-1)^2 / (2N) from every mutual information
  bool clamp_negative = false;     ///< negative radiance becomes 0
  /// Infinite radiance of float channels becomes the largest float, as that of half channels always becomes 65504; if
  /// not, such a sample is left out: in float it is a fault of the renderer, in half a bright light.
  bool clamp_infinite = false;

  // Methods with fixed weights. The standard deviation on the film is a quarter of the box width, in pixels.
  float sigma_color = 30;      ///< in the unit of the radiance (linear, over R, G and B together); 1e-30 .. 1e30
  float sigma_feature = 0.5F;  ///< in standard deviations of a group of features over the frame; 1e-6 .. 1e6

  // Of nlm.
  float damping = 0.45F;  ///< k of (9.4): larger takes patches for more alike; 1e-3 .. 1e3
  int window = 21;        ///< width of the box that neighbors come from, pixels: odd, 1 .. 255
  // Of gem.
  float gamma = 0.2F;  ///< larger holds wide Gaussians back: 0.01 .. 0.5
  // Of axis_aligned.
  float bandwidth = 2;  ///< mu of (9.22): larger makes filters narrower; 1e-3 .. 1e3
  // Of lightfield and multidim.
  int views = 128;  ///< places of lens, time and pixel that each pixel is seen from: 1 .. 65536

  /// Also filter the features with the weights of the color: Result::features.
  bool filter_features = false;
  /// Also estimate the relative error of each pixel, sqrt(relMSE): the channel "error" of Result::features.
  /// From two halves of the samples, each filtered too, which takes twice the time (docs/explain.md).
  bool estimate_error = false;
  /// Filter only this part of the data window (coordinates of the data window's own system). The pixels are those of
  /// the whole frame.
  std::optional<Window> crop;

  int threads = 0;               ///< 0: available_threads()
  std::uint64_t max_memory = 0;  ///< bytes; 0: no limit
};

}  // namespace rpf
