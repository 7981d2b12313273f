#include "run/driver.h"

#include <algorithm>
#include <cmath>

#include "frame/clean_frame.h"
#include "frame/resolve.h"
#include "learned/network_file.h"
#include "learned/observe.h"
#include "parallel/thread_count.h"
#include "rpf/methods.h"
#include "run/backends.h"
#include "run/error_estimate.h"
#include "run/estimate_bands.h"
#include "run/informative.h"
#include "run/memory.h"
#include "run/pass_summary.h"
#include "run/picture.h"
#include "run/plain_means.h"
#include "run/progress_meter.h"
#include "run/provenance.h"
#include "run/row_window.h"
#include "run/streamed_frame.h"
#include "run/streamed_passes.h"
#include "run/tiles.h"

namespace rpf {
namespace {

struct ValueRange {
  float least = 0, most = 0;
};

/// Of a carried channel over all samples. Rounding must not leave it: a float has no room above it.
ValueRange range_of(const PreparedFrame& prepared, std::size_t channel) {
  ValueRange range;
  for (std::size_t i = channel; i < prepared.colors.size(); i += prepared.facts.carried) {
    if (i == channel) range = {prepared.colors[i], prepared.colors[i]};
    range.least = std::min(range.least, prepared.colors[i]);
    range.most = std::max(range.most, prepared.colors[i]);
  }
  return range;
}

/// One run: frame, plan and backend together.
class Run {
 public:
  /// Of all samples of a frame.
  Run(SampleBuffer samples, const Settings& settings, const Control& control)
      : Run(samples, samples, settings, control) {
    check_memory(samples, settings);
    backend_ = make_backend(settings);
    if (settings.method == Method::learned) {
      take(observe(std::move(samples), settings, find_network(settings.model)));
      return;
    }
    prepared_ = prepare(std::move(samples), settings);
    if (settings.method == Method::rpf && settings.drop_uninformative) drop_uninformative(prepared_, settings);
    if (settings.method == Method::lightfield)
      light_ = make_light_field(prepared_, settings);
    else if (settings.method == Method::multidim)
      return;  // its plan is work that can be stopped: integrate_columns()
    else if (filters_pixels(settings.method))
      pixel_plan_ = make_pixel_plan(prepared_.facts, settings);
    else
      plan_ = make_plan(prepared_.facts, settings);
  }

  /// Of some rows, with what was found in the whole frame.
  Run(SampleBuffer rows, const SampleBuffer& frame, const RowFacts& facts, const Settings& settings,
      const Control& control)
      : Run(rows, frame, settings, control) {
    backend_ = make_backend(settings);
    if (const auto* observed = std::get_if<ObservedFindings>(&facts)) {
      take(observe_frame(frame, *observed, settings, find_network(settings.model)));
      clean_again(rows, find_columns(frame, settings.clamp_infinite), settings);
      const Window window = rows.data_window;
      prepared_.frame.first_sample =
          first_sample_in_frame(observe_rows(std::move(rows), frame, *observed, settings, estimate_plan_, prepared_),
                                window, frame.data_window);
      plain_energy_ = energy_of_means(prepared_.frame, prepared_.facts.crop);  // facts of the whole do not tell it
      return;
    }
    const auto& found = std::get<FrameFindings>(facts);
    prepared_ = prepare_again(std::move(rows), frame, found, settings);
    plan_ = make_plan(prepared_.facts, settings);
  }

  /// Of rows that are read when they are needed.
  Run(SampleRows& rows, ScannedRows scanned, const Settings& settings, const Control& control, std::uint64_t at_once)
      : Run(settings, control, rows.frame()) {
    backend_ = make_backend(settings);
    if (settings.method == Method::learned)
      stream_estimate(rows, std::move(scanned), at_once);
    else
      stream_passes(rows, std::get<FrameFindings>(std::move(scanned.facts)), at_once);
  }

  Result finish(const PassObserver& before_pass) {
    if (settings_.method == Method::learned) return estimate();
    if (passes_) return finish_streamed();
    if (settings_.method == Method::lightfield) return see_views();
    if (settings_.method == Method::multidim) return integrate_columns();
    return filters_pixels(settings_.method) ? filter_pixels() : run_passes(before_pass);
  }

 private:
  void stream_estimate(SampleRows& rows, ScannedRows scanned, std::uint64_t at_once) {
    found_ = std::move(std::get<ObservedFindings>(scanned.facts));
    raw_ = streamed_size(rows, found_.cleaned.most_samples);
    take(observe_frame(rows.frame(), found_, settings_, find_network(settings_.model)));
    prepared_.frame.first_sample = std::move(scanned.first_sample);
    const std::uint64_t need = bands().bytes;
    const std::uint64_t left = settings_.max_memory > need ? settings_.max_memory - need : 0;
    stream_ = std::make_unique<StreamedFrame>(rows, found_, settings_, estimate_plan_, prepared_,
                                              std::move(scanned.kept), left / 4 * 3, at_once);
  }

  void stream_passes(SampleRows& rows, FrameFindings found, std::uint64_t at_once) {
    frame_found_ = std::move(found);
    prepared_ = prepare_without_samples(rows.frame(), frame_found_, settings_);
    plan_ = make_plan(prepared_.facts, settings_);
    passes_ = std::make_unique<StreamedPasses>(rows, frame_found_, settings_, plan_, prepared_, at_once);
  }

  /// What does not depend on how samples come.
  Run(const Settings& settings, const Control& control, const SampleBuffer& frame)
      : settings_(settings), control_(control), threads_(thread_count(settings)) {
    validate(settings);
    geometry_.data_window = settings.crop.value_or(frame.data_window);
    geometry_.display_window = frame.display_window;
    geometry_.metadata = frame.metadata;
  }
  Run(const SampleBuffer& samples, const SampleBuffer& frame, const Settings& settings, const Control& control)
      : Run(settings, control, frame) {
    samples.validate();
    raw_ = {frame_size(samples), samples.layout, room_of(samples)};
    raw_.size.pixels = frame.data_window.pixel_count();
  }

  EstimateBands bands() const { return estimate_bands(raw_.size, raw_.layout, raw_.room, settings_, *backend_); }

  void take(Observed observed) {
    prepared_ = std::move(observed.prepared);
    estimate_plan_ = std::move(observed.plan);
    plain_energy_ = observed.energy;
  }

  Pixels resolved() const { return resolve(prepared_.frame, backend_->colors(), plan_.carried); }

  Result run_passes(const PassObserver& before_pass) {
    ProgressMeter meter(plan_, control_);
    Result result;
    load_backend(backend_, settings_, prepared_.frame, std::move(prepared_.colors), plan_, meter);
    Pixels pixels = resolved();
    const double plain_energy = energy(pixels, prepared_.facts);
    for (int pass = 0; pass < static_cast<int>(plan_.passes.size()); ++pass) {
      if (before_pass) before_pass(*backend_, plan_, pass);
      PassReport report = run_pass(pass, meter);
      pixels = resolved();
      report.energy = share_of_energy(energy(pixels, prepared_.facts), plain_energy);
      result.report.passes.push_back(report);
    }
    describe(result, pixels);
    result.report.seconds = meter.seconds();
    return result;
  }

  /// The same of rows that are read when they are needed.
  Result finish_streamed() {
    ProgressMeter meter(plan_, control_);
    passes_->run(backend_, control_, meter);
    Result result;
    result.report.passes = passes_->reports();
    describe(result, passes_->pixels());
    result.report.seconds = meter.seconds();
    return result;
  }

  /// The learned estimator, band by band where memory is limited: a band has the pixels of the whole.
  Result estimate() {
    ProgressMeter meter(control_);
    const FrameFacts& facts = prepared_.facts;
    get_ready_estimate(backend_, settings_, estimate_plan_, meter);
    const int band_rows = bands().rows;
    backend_->load_estimate(prepared_.frame, estimate_plan_);
    Pixels pixels(prepared_.frame.first_sample.size() * facts.carried, 0.0F);
    const Window& crop = facts.crop;
    for (int y = crop.y; y < crop.y + crop.height; y += band_rows) {
      const Window band{crop.x, y, crop.width, std::min(band_rows, crop.y + crop.height - y)};
      const double share = static_cast<double>(band.height) / crop.height;
      place(backend_->estimate(band, [&](double part) { meter.add_part(share * part); }), band, pixels);
    }
    PlainMeans of_all(prepared_, threads_);
    if (!stream_) of_all.add_rows(0, facts.height);
    const PlainMeans& means = stream_ ? stream_->means() : of_all;
    means.draw_to_means(pixels, estimate_plan_.exposure);
    Result result;
    result.report.model = estimate_plan_.network->name;
    result.report.model_hash = estimate_plan_.network->hash;
    describe_at_once(result, pixels, stream_ ? stream_->energy() : plain_energy_, meter);
    return result;
  }

  /// A method that filters pixels, the whole frame whatever the crop.
  Result filter_pixels() {
    ProgressMeter meter(control_);
    const double plain_energy = energy_of_means(prepared_.frame, prepared_.facts.crop);
    get_ready_steps(backend_, settings_, meter);
    const std::vector<float> planes =
        backend_->run_steps(pixel_plan_, pixel_planes(prepared_, pixel_plan_.inputs, pixel_plan_.planes),
                            [&](double part) { meter.add_part(part); });
    Result result;
    describe_at_once(result, pixels_of(planes.data() + pixel_plan_.result * pixel_plan_.pixels()), plain_energy, meter);
    return result;
  }

  /// The light field, the whole frame whatever the crop.
  Result see_views() {
    ProgressMeter meter(control_);
    const double plain_energy = energy_of_means(prepared_.frame, prepared_.facts.crop);
    get_ready_views(backend_, settings_, meter);
    const std::vector<float> sums = backend_->see_views(light_, [&](double part) { meter.add_part(part); });
    Result result;
    describe_at_once(result, mean_of_views(std::move(light_.means), sums), plain_energy, meter);
    return result;
  }

  /// Columns of pixels in the space of the samples, the whole frame whatever the crop.
  Result integrate_columns() {
    ProgressMeter meter(control_);
    const double plain_energy = energy_of_means(prepared_.frame, prepared_.facts.crop);
    get_ready_columns(backend_, settings_, meter);
    PixelColumns columns = make_pixel_columns(prepared_, settings_, threads_, [&] { meter.check(); });
    const std::vector<float> sums = backend_->integrate_columns(columns, [&](double part) { meter.add_part(part); });
    Result result;
    describe_at_once(result, mean_of_views(std::move(columns.means), sums), plain_energy, meter);
    return result;
  }

  /// Of the means of pixels, and the sums of what their views saw.
  Pixels mean_of_views(std::vector<float> means, const std::vector<float>& sums) const {
    const std::size_t count = means.size() / prepared_.facts.carried;
    const float* seen = sums.data() + means.size();
    for (std::size_t i = 0; i < means.size(); ++i)
      means[i] = kernel::rpf_mean_of_views(means[i], sums[i], seen[i % count]);
    return pixels_of(means.data());
  }

  /// Of planes, one for each carried channel; 0 where there are no samples.
  Pixels pixels_of(const float* planes) const {
    const std::size_t carried = prepared_.facts.carried, count = prepared_.frame.first_sample.size() - 1;
    Pixels pixels(count * carried);
    for (std::size_t c = 0; c < carried; ++c) {
      const ValueRange range = range_of(prepared_, c);
      for (std::size_t p = 0; p < count; ++p)
        pixels[p * carried + c] =
            prepared_.frame.samples(p) > 0 ? std::clamp(planes[c * count + p], range.least, range.most) : 0;
    }
    return pixels;
  }

  /// The report of what has no passes.
  void describe_at_once(Result& result, const Pixels& pixels, double plain_energy, const ProgressMeter& meter) {
    PassReport report;
    report.energy = share_of_energy(energy(pixels, prepared_.facts), plain_energy);
    report.seconds = result.report.seconds = meter.seconds();
    result.report.passes.push_back(report);
    describe(result, pixels);
  }

  /// Pixels without samples stay 0, whatever is around them.
  void place(const std::vector<float>& part, const Window& band, Pixels& pixels) const {
    const std::size_t carried = prepared_.facts.carried;
    const float* from = part.data();
    for (int y = band.y; y < band.y + band.height; ++y)
      for (int x = band.x; x < band.x + band.width; ++x, from += carried) {
        const std::size_t pixel = static_cast<std::size_t>(y) * prepared_.facts.width + x;
        if (prepared_.frame.samples(pixel) > 0) std::copy_n(from, carried, pixels.data() + pixel * carried);
      }
  }

  PassReport run_pass(int pass, ProgressMeter& meter) {
    const PassPlan& plan = plan_.passes[static_cast<std::size_t>(pass)];
    const double start = meter.seconds();
    meter.add(pass, 0);
    for (const Window& tile : cut_into_tiles(plan_, pass, plan.region, control_, threads_)) {
      backend_->run(pass, tile);
      meter.add(pass, tile.pixel_count());
    }
    backend_->end_pass();
    PassReport report = summarize(backend_->statistics(), prepared_.frame, plan);
    report.seconds = meter.seconds() - start;
    return report;
  }

  void describe(Result& result, const Pixels& pixels) {
    describe_input(*backend_, prepared_, result.report);
    geometry_.metadata = provenance(geometry_.metadata, settings_, result.report);
    make_images(pixels, prepared_, geometry_, result);
  }

  const Settings& settings_;
  const Control& control_;
  int threads_;
  RawSize raw_;
  Image geometry_;  ///< windows and metadata of the result
  PreparedFrame prepared_;
  Plan plan_;
  EstimatePlan estimate_plan_;
  double plain_energy_ = 0;  ///< of a learned estimate in memory: what its picture's energy is held against
  PixelPlan pixel_plan_;
  LightField light_;
  ObservedFindings found_;
  FrameFindings frame_found_;
  // Where samples are read when they are needed:
  std::unique_ptr<StreamedFrame> stream_;
  std::unique_ptr<StreamedPasses> passes_;
  std::unique_ptr<Backend> backend_;  ///< last: it refers to frame and plan
};

}  // namespace

void describe_input(const Backend& backend, const PreparedFrame& prepared, Report& report) {
  report.backend = backend.description();
  report.random = prepared.facts.variables.random_names;
  report.features = prepared.facts.variables.feature_names;
  report.dropped = prepared.dropped;
  report.uninformative = prepared.uninformative;
  report.notes = prepared.notes;
}

Result run_filter(SampleBuffer samples, const Settings& settings, const Control& control,
                  const PassObserver& before_pass) {
  return Run(std::move(samples), settings, control).finish(before_pass);
}

Result run_rows(SampleBuffer rows, const SampleBuffer& frame, const RowFacts& facts, const Settings& settings,
                const Control& control) {
  return Run(std::move(rows), frame, facts, settings, control).finish({});
}

Result run_streamed(SampleRows& rows, ScannedRows scanned, const Settings& settings, const Control& control,
                    std::uint64_t at_once) {
  return Run(rows, std::move(scanned), settings, control, at_once).finish({});
}

Result filter(SampleBuffer samples, const Settings& settings, const Control& control) {
  if (settings.estimate_error) return filter_with_error(std::move(samples), settings, control);
  return run_filter(std::move(samples), settings, control, {});
}

}  // namespace rpf
