#include <algorithm>
#include <numeric>

#include "explain/contributions.h"
#include "explain/pixel_number.h"
#include "frame/prepare.h"
#include "frame/resolve.h"
#include "learned/network_file.h"
#include "learned/observe.h"
#include "rpf/error.h"
#include "rpf/explain.h"
#include "run/backends.h"
#include "run/memory.h"
#include "run/plain_means.h"
#include "run/progress_meter.h"

namespace rpf {
namespace {

/// One pixel's estimate, from a frame that is only prepared.
class Estimated {
 public:
  Estimated(SampleBuffer samples, const Settings& settings, const PixelPosition& position)
      : settings_(settings),
        data_window_(samples.data_window),
        number_(pixel_number(position, samples)),
        backend_(make_backend(settings)) {
    result_.position = position;
    check_memory(samples, settings);
    Observed observed = observe(std::move(samples), settings, find_network(settings.model));
    prepared_ = std::move(observed.prepared);
    check_has_samples(position, number_, prepared_.frame.first_sample);
    plan_ = std::move(observed.plan);
    result_.model = plan_.network->name;
  }

  ExplainedEstimate explain(const Control& control) {
    const int x = static_cast<int>(number_) % plan_.width, y = static_cast<int>(number_) / plan_.width;
    const Window region = region_of_shares(plan_, x, y), window = window_around(plan_, region);
    ProgressMeter meter(control);
    get_ready_estimate(backend_, settings_, plan_, meter);
    backend_->load_estimate(prepared_.frame, plan_);
    const std::vector<EstimateStage> stages = backend_->trace_estimate(region);
    const float* color = stages.back().values.data() + place(window, x, y) * stages.back().channels;
    const std::array<double, 3> exact = mean_color(prepared_.frame, number_);
    std::array<float, 3> mean{};
    std::transform(exact.begin(), exact.end(), mean.begin(), [](double c) { return static_cast<float>(c); });
    const double own =
        own_share(PixelWeights(prepared_.frame, number_).effective_samples(), color, mean.data(), plan_.exposure);
    PixelShares shares = pixel_shares(plan_, stages, window, counts(window), x, y);
    if (own > 0) draw_to_mean(shares, own, place(window, x, y), mean);
    for (int row = region.y; row < region.y + region.height; ++row)
      for (int column = region.x; column < region.x + region.width; ++column)
        result_.shares.push_back(static_cast<float>(shares.pixels[place(window, column, row)]));
    result_.window = {region.x + data_window_.x, region.y + data_window_.y, region.width, region.height};
    std::copy(shares.factor.begin(), shares.factor.end(), result_.factor.begin());
    list_samples(shares);
    for (std::size_t c = 0; c < 3; ++c) {
      result_.result.at(c) = radiance(drawn(color[c], mean.at(c), own));
      result_.mean.at(c) = radiance(mean.at(c));
    }
    return std::move(result_);
  }

 private:
  static std::size_t place(const Window& window, int x, int y) {
    return static_cast<std::size_t>(y - window.y) * static_cast<std::size_t>(window.width) +
           static_cast<std::size_t>(x - window.x);
  }
  std::uint32_t number(int x, int y) const { return static_cast<std::uint32_t>(y * plan_.width + x); }
  float radiance(float scaled) const { return scaled / prepared_.facts.radiance_scale; }

  std::vector<std::uint32_t> counts(const Window& window) const {
    std::vector<std::uint32_t> all;
    for (int y = window.y; y < window.y + window.height; ++y)
      for (int x = window.x; x < window.x + window.width; ++x) all.push_back(prepared_.frame.samples(number(x, y)));
    return all;
  }

  /// use(x, y, sample, share) for all samples of the window that have one.
  template <typename Use>
  void for_samples(const PixelShares& shares, Use use) const {
    const Window& window = shares.window;
    auto within = shares.within_pixels.begin();
    for (int y = window.y; y < window.y + window.height; ++y)
      for (int x = window.x; x < window.x + window.width; ++x) {
        const std::uint32_t first = prepared_.frame.first_sample[number(x, y)];
        for (std::uint32_t i = 0; i < prepared_.frame.samples(number(x, y)); ++i, ++within)
          if (const double share = *within * shares.pixels[place(window, x, y)]; share > 0) use(x, y, first + i, share);
      }
  }

  /// Gives the pixel's own samples `own` more, for its mean; the factor becomes that of all.
  void draw_to_mean(PixelShares& shares, double own, std::size_t pixel, const std::array<float, 3>& mean) const {
    std::array<double, 3> of_passes{};
    for_samples(shares, [&](int /*x*/, int /*y*/, std::uint32_t sample, double share) {
      for (std::size_t c = 0; c < 3; ++c) of_passes.at(c) += share * prepared_.frame.record(sample)[c];
    });
    for (std::size_t c = 0; c < 3; ++c) {
      const double passes = (1 - own) * of_passes.at(c), all = passes + own * mean.at(c);
      if (all != 0) shares.factor.at(c) = (shares.factor.at(c) * passes + own * mean.at(c)) / all;
    }
    for (double& share : shares.pixels) share *= 1 - own;
    const std::vector<std::uint32_t> samples = counts(shares.window);
    const auto first = std::accumulate(samples.begin(), samples.begin() + static_cast<std::ptrdiff_t>(pixel), 0U);
    const double all = shares.pixels[pixel] + own;
    const PixelWeights weights(prepared_.frame, number_);
    for (std::uint32_t i = 0; i < samples[pixel]; ++i) {
      const double of_mean = weights.of(prepared_.frame.first_sample[number_] + i) / weights.total();
      double& within = shares.within_pixels[first + i];
      within = (shares.pixels[pixel] * within + own * of_mean) / all;
    }
    shares.pixels[pixel] = all;
  }

  void list_samples(const PixelShares& shares) {
    double squares = 0;
    for_samples(shares, [&](int x, int y, std::uint32_t sample, double share) {
      const float* color = prepared_.frame.record(sample);
      result_.samples.push_back({{x + data_window_.x, y + data_window_.y},
                                 {radiance(color[0]), radiance(color[1]), radiance(color[2])},
                                 static_cast<float>(share)});
      squares += share * share;
    });
    std::stable_sort(result_.samples.begin(), result_.samples.end(),
                     [](const Contribution& a, const Contribution& b) { return a.share > b.share; });
    if (squares > 0) result_.effective_samples = static_cast<float>(1 / squares);
  }

  const Settings& settings_;
  Window data_window_;
  std::uint32_t number_;
  PreparedFrame prepared_;
  EstimatePlan plan_;
  std::unique_ptr<Backend> backend_;  ///< refers to frame and plan
  ExplainedEstimate result_;
};

}  // namespace

ExplainedEstimate explain_estimate(SampleBuffer samples, const Settings& settings, const PixelPosition& pixel,
                                   const Control& control) {
  samples.validate();
  validate(settings);
  if (settings.method != Method::learned)
    throw Error(ErrorKind::usage, "explain_estimate: settings of a preset are expected (Method::learned)");
  return Estimated(std::move(samples), settings, pixel).explain(control);
}

}  // namespace rpf
