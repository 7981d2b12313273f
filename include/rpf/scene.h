// Synthetic scenes: a small Monte Carlo renderer whose product is sample vectors (docs/scenes.md).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "rpf/filter.h"
#include "rpf/image.h"
#include "rpf/rows.h"
#include "rpf/samples.h"

namespace rpf {

/// How the random numbers of one pixel's samples are placed. All three have the same expectation.
enum class SceneSampler {
  random,      ///< independent numbers
  stratified,  ///< correlated multi-jittered, shuffled for every pair of dimensions (Kensler 2013)
  sobol        ///< Owen-scrambled Sobol pairs, shuffled for every pair of dimensions
};

/// How to render.
struct SceneOptions {
  int width = 480, height = 270;  ///< pixels, 1 .. 1,048,576 each
  int samples = 4;                ///< a pixel, 1 .. 1,048,576; the mean number where counts vary
  std::uint32_t seed = 1;
  SceneSampler sampler = SceneSampler::random;

  /// Counts vary: every pixel gets 0 .. 2 * samples, all equally likely.
  bool adaptive = false;
  /// Counts vary: `samples` times the first channel of this image of the frame's size, values 0 or more; the fraction
  /// left is rounded up or down at random so that the mean is kept. Beats `adaptive`.
  std::optional<Image> density;

  /// The positions written (feature.P, feature.P2) are world_scale * position + world_offset, computed in double and
  /// rounded to float once: a renderer that works around its camera. The picture does not change.
  float world_scale = 1;  ///< above 0
  std::array<float, 3> world_offset = {0, 0, 0};

  /// Also write feature.penumbra.slope and .width, which the method axis-aligned needs (docs/file-format.md). The
  /// picture does not change.
  bool penumbra = false;

  /// Also write what the method lightfield needs: feature.opening and .closing, and where the camera and its lens are,
  /// as attributes (docs/file-format.md). The picture does not change.
  bool lightfield = false;

  int threads = 0;  ///< 0: available_threads(). Never changes the result.
};

/// A scene and what it is for.
struct SceneInfo {
  std::string name;
  std::string purpose;  ///< one line
};

/// The scenes there are, in the order of docs/scenes.md.
std::vector<SceneInfo> scenes();

/// Renders the samples of a scene. Layout: R G B film.X/Y random.lens.U/V random.time random.light.U/V random.bsdf.U/V
/// feature.N, P, albedo, uv (first hit), feature.N2, P2, albedo2 (second hit), feature.hit, and what SceneOptions ask
/// for. What a scene does not use (no lens, nothing moves, ...) is 0 in all samples; what a sample does not have (no
/// hit) is NaN. Metadata: rpf:seed, rpf:renderer, rpf:scene, rpf:sampler, and the camera's where it is asked for. The
/// same options give the same bits. Throws Error(usage) for an unknown name, naming those there are, or an option that
/// cannot be; Error(cancelled).
SampleBuffer render_scene(const std::string& name, const SceneOptions& options, const Control& control = {});

/// The same samples, rendered when their rows are read: a frame larger than memory, for write_sample_rows(). Throws
/// Error(usage).
std::unique_ptr<SampleRows> open_scene_rows(const std::string& name, const SceneOptions& options);

/// The attribute of a reference that tells its own relMSE.
constexpr const char* residual_attribute = "rpf:residualRelMSE";

/// Renders `options.samples` (2 or more) samples a pixel and keeps only their mean: R, G, B. They are drawn in two
/// halves, independent of each other and of render_scene()'s samples of the same seed. Metadata: those of
/// render_scene(), rpf:samplesPerPixel (int) and residual_attribute (float): the reference's own relMSE, estimated from
/// the difference of the halves. `adaptive`, `density`, scale and offset mean nothing here.
Image render_reference(const std::string& name, const SceneOptions& options, const Control& control = {});

}  // namespace rpf
