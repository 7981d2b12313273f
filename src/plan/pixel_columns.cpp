#include "plan/pixel_columns.h"

#include <algorithm>
#include <array>
#include <limits>
#include <optional>

#include "frame/pixel_planes.h"
#include "frame/place_of.h"
#include "plan/leaf_metrics.h"
#include "plan/plan.h"
#include "plan/sequence.h"

namespace rpf {
namespace {

constexpr float lenses_along_film = 15;  ///< as many pixels as a frame is long are worth: (12.1)
constexpr float nowhere = std::numeric_limits<float>::quiet_NaN();

/// Of u, v and t the variable of a record; nothing where it is not there or does not vary. Then it is 0, of samples and
/// of points alike.
using Dimensions = std::array<std::optional<std::size_t>, 3>;

Dimensions find_dimensions(const std::vector<std::string>& random_names) {
  Dimensions dimensions;
  constexpr const char* names[] = {"lens.U", "lens.V", "time"};
  for (std::size_t k = 0; k < dimensions.size(); ++k) {
    const std::optional<std::size_t> place = place_of(names[k], random_names);
    if (place) dimensions[k] = Variables::random + *place;
  }
  return dimensions;
}

/// What the whole lens, or the whole time, is worth on the film. Blur in pixels grows with the frame, so this does.
float pixels_of_lens(const Frame& frame) {
  return static_cast<float>(std::max(frame.width, frame.height)) / lenses_along_film;
}

/// [sample][RPF_DIMENSIONS]: (12.1); of a sample without a weight NaN.
std::vector<float> sample_places(const Frame& frame, const Dimensions& dimensions) {
  std::vector<float> places(frame.sample_count() * RPF_DIMENSIONS, 0.0F);
  const float lens = pixels_of_lens(frame);
  for (std::size_t i = 0; i < frame.sample_count(); ++i) {
    const float* record = frame.record(i);
    float* place = &places[i * RPF_DIMENSIONS];
    std::copy_n(record + Variables::position, 2, place);
    for (std::size_t k = 0; k < dimensions.size(); ++k)
      if (dimensions[k]) place[2 + k] = lens * record[*dimensions[k]];
    if (!frame.weights.empty() && !(frame.weight(i) > 0)) place[0] = nowhere;
  }
  return places;
}

kernel::rpf_point point(int n, const Dimensions& dimensions, float lens) {
  const auto [x, y, time, u, v] = place_in_sequence(n);
  kernel::rpf_point result = {{static_cast<float>(x), static_cast<float>(y), 0, 0, 0}};
  const double random[] = {u, v, time};
  for (std::size_t k = 0; k < dimensions.size(); ++k)
    if (dimensions[k]) result.at[2 + k] = static_cast<float>(lens * random[k]);
  return result;
}

}  // namespace

PixelColumns make_pixel_columns(const PreparedFrame& prepared, const Settings& settings, int threads,
                                const std::function<void()>& check) {
  validate(settings);
  PixelColumns result;
  const Dimensions dimensions = find_dimensions(prepared.facts.variables.random_names);
  result.tree = make_sample_tree(sample_places(prepared.frame, dimensions));
  check();
  result.metrics = leaf_metrics(result.tree, prepared.frame, threads, check);
  result.shape = {prepared.frame.width, prepared.frame.height, static_cast<kernel::uint>(prepared.facts.carried),
                  result.tree.leaves};
  for (int n = 0; n < settings.views; ++n)
    result.points.push_back(point(n, dimensions, pixels_of_lens(prepared.frame)));
  result.colors = prepared.colors;
  result.means = pixel_means(prepared);
  return result;
}

}  // namespace rpf
