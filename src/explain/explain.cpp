#include "rpf/explain.h"

#include <fmt/format.h>

#include <algorithm>

#include "explain/attribution.h"
#include "explain/layers.h"
#include "explain/pixel_number.h"
#include "explain/traced_pixel.h"
#include "frame/clean_frame.h"
#include "frame/resolve.h"
#include "frame/selection.h"
#include "parallel/thread_count.h"
#include "plan/neighborhood_size.h"
#include "rpf/error.h"
#include "run/backends.h"
#include "run/driver.h"
#include "run/informative.h"
#include "run/memory.h"
#include "run/pass_summary.h"
#include "run/progress_meter.h"
#include "run/provenance.h"
#include "run/tiles.h"

namespace rpf {
namespace {

constexpr int explained_box = 21;

void check(const Settings& settings) {
  validate(settings);
  const auto refuse = [](const std::string& what) { throw Error(ErrorKind::usage, "explain: " + what); };
  if (settings.method != Method::rpf) refuse("only --method rpf measures what is explained");
  if (settings.box_widths.size() != 1)
    refuse(
        fmt::format("{} box widths; exactly one is expected, that of the pass to explain", settings.box_widths.size()));
  if (settings.crop) refuse("a crop; the whole frame is explained");
}

/// Bytes beside those of filtering, each random parameter being a group of its own.
std::uint64_t extra_bytes(std::uint64_t pixels, const SampleLayout& layout, const Settings& settings) {
  const Selection selection = select_channels(layout, settings);
  return pixels * sizeof(float) * Layers::count(selection.features.size(), selection.random.size()) +
         attribution_bytes(pixels, selection.random.size());
}

/// One run: frame, plan and backend together.
class Run {
 public:
  Run(SampleBuffer samples, const Settings& settings, const Control& control, const std::optional<PixelPosition>& pixel)
      : settings_(settings), control_(control), threads_(thread_count(settings)) {
    samples.validate();
    check(settings);
    if (pixel) traced_ = pixel_number(*pixel, samples);
    geometry_.data_window = samples.data_window;
    geometry_.display_window = samples.display_window;
    geometry_.metadata = samples.metadata;
    check_memory(samples, settings, extra_bytes(samples.data_window.pixel_count(), samples.layout, settings));
    backend_ = make_backend(settings);
    if (pixel) check_trace(*pixel, samples);
    prepared_ = prepare(std::move(samples), settings);
    if (pixel) check_has_samples(*pixel, *traced_, prepared_.frame.first_sample);
    if (settings.drop_uninformative) drop_uninformative(prepared_, settings);
    plan_ = make_plan(prepared_.facts, settings);
    plan_.explain = true;
    plan_.outlier_step = false;  // it would hide how much noise the filtered samples keep
  }

  Explanation finish() {
    ProgressMeter meter(plan_, control_);
    const std::vector<RandomGroup> groups = random_groups(plan_.variables);
    Layers layers(prepared_, plan_, groups);
    Explanation result;
    const Attribution attribution = attribute_noise(prepared_.frame, groups, threads_, [&] { meter.add(0, 0); });
    load_backend(backend_, settings_, prepared_.frame, std::move(prepared_.colors), plan_, meter);
    const std::vector<float> mean = resolved();
    if (traced_) result.pixel = explain_trace(backend_->trace(0, *traced_), prepared_, plan_, geometry_.data_window);
    for (const Window& tile : cut_into_tiles(plan_, 0, plan_.passes[0].region, control_, threads_)) {
      backend_->run(0, tile);
      layers.add_tile(*backend_, tile);
      meter.add(0, tile.pixel_count());
    }
    backend_->end_pass();
    layers.add_colors(mean, resolved());
    layers.add_features();
    layers.add_noise(attribution, backend_->colors());
    describe(result, groups, meter);
    result.layers = layers.take(geometry_);
    if (result.pixel) complete(*result.pixel, result.layers);
    return result;
  }

 private:
  /// Every neighbor has a weight for every sample of the pixel's own: in a crowded one that is more than the pass
  /// takes.
  void check_trace(const PixelPosition& pixel, const SampleBuffer& samples) const {
    const std::uint32_t own = samples.first_sample[*traced_ + 1] - samples.first_sample[*traced_],
                        most = neighborhood_size(settings_, settings_.box_widths.front()).size(own);
    const std::uint64_t need = predict_explain_memory(frame_size(samples), samples.layout, settings_) +
                               backend_->trace_bytes(own, std::max(own, most));
    if (settings_.max_memory == 0 || need <= settings_.max_memory) return;
    constexpr double megabyte = 1 << 20;
    throw Error(ErrorKind::memory,
                fmt::format("pixel {},{}: explaining its {} samples needs {:.0f} MB, the limit is {:.0f} MB; raise "
                            "--max-memory or choose a pixel with fewer samples",
                            pixel.x, pixel.y, own, static_cast<double>(need) / megabyte,
                            static_cast<double>(settings_.max_memory) / megabyte));
  }

  std::vector<float> resolved() const { return resolve(prepared_.frame, backend_->colors(), plan_.carried); }

  void describe(Explanation& result, const std::vector<RandomGroup>& groups, const ProgressMeter& meter) {
    for (const RandomGroup& group : groups) result.groups.push_back(group.name);
    describe_input(*backend_, prepared_, result.report);
    result.report.passes.push_back(summarize(backend_->statistics(), prepared_.frame, plan_.passes[0]));
    result.report.seconds = meter.seconds();
    geometry_.metadata = provenance(geometry_.metadata, settings_, result.report);
  }

  /// What the layers know of the pixel.
  void complete(ExplainedPixel& pixel, const Image& layers) const {
    const float* values = layers.pixel(*traced_);
    for (std::size_t c = 0; c < 3; ++c) {
      pixel.mean[c] = values[c];
      pixel.filtered[c] = values[3 + c];
    }
    for (std::size_t c = 0; c < layers.channel_count(); ++c)
      if (layers.channels[c] == "neighborhood.effective") pixel.effective_samples = values[c];
  }

  const Settings& settings_;
  const Control& control_;
  int threads_;
  std::optional<std::uint32_t> traced_;
  Image geometry_;  ///< windows and metadata of the result
  PreparedFrame prepared_;
  Plan plan_;
  std::unique_ptr<Backend> backend_;  ///< last: it refers to frame and plan
};

}  // namespace

Settings explain_settings() {
  Settings settings;
  settings.profile = Profile::paper;
  settings.box_widths = {explained_box};
  return settings;
}

Explanation explain(SampleBuffer samples, const Settings& settings, const Control& control,
                    const std::optional<PixelPosition>& pixel) {
  return Run(std::move(samples), settings, control, pixel).finish();
}

std::vector<std::string> explain_layers(const SampleLayout& layout, const Settings& settings) {
  const Selection selection = select_channels(layout, settings);
  Variables variables;
  for (const std::string& slot : selection.random) variables.random_names.push_back(short_name(slot));
  for (const std::string& slot : selection.features) variables.feature_names.push_back(short_name(slot));
  return Layers::names(variables, random_groups(variables));
}

std::uint64_t predict_explain_memory(const FrameSize& size, const SampleLayout& layout, const Settings& settings) {
  return predict_memory(size, layout, settings) + extra_bytes(size.pixels, layout, settings);
}

}  // namespace rpf
