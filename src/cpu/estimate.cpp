#include "cpu/estimate.h"

#include <algorithm>
#include <utility>

#include "parallel/vectors.h"

namespace rpf {
namespace {

using kernel::fma;
using kernel::uint;

double products(const NetworkLayer& layer) { return static_cast<double>(layer.inputs) * layer.outputs * layer.taps; }

/// Multiply-adds, or operations that take as long, of a sample that is seen, of one that is weighed, of a pixel's sums
/// in a pass.
double seeing(const Network& n) { return products(n.sample1()) + products(n.sample2()) + 200; }
double weighing(const Network& n) { return seeing(n) + products(n.weight1()); }
double passing(const Network& n, std::size_t values) {
  return 25.0 * (n.embedding + RPF_GUIDES + 15 + static_cast<double>(values)) + 10.0 * n.embedding;
}

int halved(int size) { return (size + 1) / 2; }

}  // namespace

Estimate::Estimate(const Frame& frame, const EstimatePlan& plan, const Window& window, RowLoop for_rows,
                   std::vector<EstimateStage>* stages)
    : frame_(frame),
      plan_(plan),
      network_(*plan.network),
      window_(window),
      for_rows_(std::move(for_rows)),
      stages_(stages),
      guides_(window.width, window.height, RPF_GUIDES),
      albedo_(window.width, window.height, RPF_ALBEDO_SUMS) {
  first_sample_ = {0};
  for (int y = 0; y < window.height; ++y)
    for (int x = 0; x < window.width; ++x)
      first_sample_.push_back(first_sample_.back() + frame.samples(frame_pixel(x, y)));
}

double Estimate::work(const EstimatePlan& plan, const Window& window, double samples) {
  const Network& n = *plan.network;
  double sum = samples * (seeing(n) + weighing(n));
  double cells = static_cast<double>(window.pixel_count());
  sum += cells * products(n.enter());
  for (int l = 0; l < n.levels(); ++l, cells /= 4) {
    sum += cells * products(n.down(l, false));
    if (l > 0) sum += cells * products(n.down(l, true));
    if (l + 1 < n.levels()) sum += cells * (products(n.up(l, false)) + products(n.up(l, true)));
  }
  const auto pixels = static_cast<double>(window.pixel_count());
  const int color_passes = n.color_passes(), albedo_passes = plan.has_albedo ? n.passes() - color_passes : 0;
  return sum + pixels * (color_passes * passing(n, kernel::rpf_sums(static_cast<uint>(plan.carried))) +
                         albedo_passes * passing(n, RPF_ALBEDO_SUMS));
}

std::uint64_t Estimate::bytes(const EstimatePlan& plan, const Window& window) {
  const Network& n = *plan.network;
  double in_layers = 3.0 * n.channels[0], share = 1;
  for (const int channels : n.channels) {
    in_layers += share * channels;
    share /= 4;
  }
  const double sums = kernel::rpf_sums(static_cast<uint>(plan.carried));
  const double in_passes = n.channels[0] + n.embedding + RPF_GUIDES + 1 + 2 * std::max<double>(sums, RPF_ALBEDO_SUMS);
  const double always = RPF_GUIDES + 2 * RPF_ALBEDO_SUMS + sums + static_cast<double>(plan.carried) + 1;
  const auto pixels = static_cast<double>(window.pixel_count());
  return static_cast<std::uint64_t>(pixels * sizeof(float) * (always + std::max(in_layers, in_passes)));
}

void Estimate::head(int x, int y, uint first, uint count, float* out) const {
  dense(network_.head(), last_.at(x, y), static_cast<int>(first), static_cast<int>(count), out);
}

void Estimate::for_rows_of_samples(double row_work, bool again, const std::function<void(int)>& row) {
  for (int first = 0, end = 0; first < window_.height; first = end) {
    end = frame_.bring(window_.y + first, window_.y + window_.height, again) - window_.y;
    for_rows_(end - first, row_work, [&](int y) { row(first + y); });
  }
}

Field Estimate::see_pixels() {
  const NetworkLayer& enter = network_.enter();
  Field entered(window_.width, window_.height, static_cast<std::size_t>(enter.outputs));
  Field seen(stages_ ? window_.width : 0, stages_ ? window_.height : 0, static_cast<std::size_t>(enter.inputs));
  const double samples = static_cast<double>(first_sample_.back()) / window_.height;
  for_rows_of_samples(samples * seeing(network_) + window_.width * products(enter), true, [&](int y) {
    SampleNetwork network(frame_, plan_);
    std::vector<float> values(static_cast<std::size_t>(enter.inputs));
    float albedo[RPF_ALBEDO_SUMS];
    for (int x = 0; x < window_.width; ++x) {
      network.see_pixel(frame_pixel(x, y), values.data(), albedo);
      dense(enter, values.data(), 0, enter.outputs, entered.at(x, y));
      activate(entered.at(x, y), enter.outputs);
      const float* guides = values.data() + 2 * network_.sample_features + RPF_STATISTIC_GUIDES;
      for (std::size_t k = 0; k < RPF_GUIDES; ++k) guides_.at(y, k)[x] = guides[k];
      for (std::size_t k = 0; k < RPF_ALBEDO_SUMS; ++k) albedo_.at(y, k)[x] = albedo[k];
      if (stages_) std::copy(values.begin(), values.end(), seen.at(x, y));
    }
  });
  keep("pixel", seen);
  keep("enter", entered);
  return entered;
}

Field Estimate::convolved(const NetworkLayer& layer, const std::vector<Source>& sources, int width, int height) {
  Field out(width, height, static_cast<std::size_t>(layer.outputs));
  for_rows_(height, width * products(layer), [&](int y) { convolve_row(layer, sources, y, out); });
  keep(layer.name, out);
  return out;
}

Field Estimate::halved(const Field& in) {
  Field out(rpf::halved(in.width), rpf::halved(in.height), in.channels);
  for_rows_(out.height, 0, [&](int y) { halve_row(in, y, out); });
  return out;
}

void Estimate::run_layers() {
  const auto next = [&](const NetworkLayer& layer, const Field& in) {
    return convolved(layer, {{&in, 0}}, in.width, in.height);
  };
  std::vector<Field> levels;
  levels.push_back(next(network_.down(0, false), see_pixels()));
  for (int l = 1; l < network_.levels(); ++l) {
    const Field first = next(network_.down(l, false), halved(levels.back()));
    levels.push_back(next(network_.down(l, true), first));
  }
  last_ = std::move(levels.back());
  for (int l = network_.levels() - 2; l >= 0; --l) {
    levels.pop_back();
    const Field& own = levels.back();
    const Field first = convolved(network_.up(l, false), {{&last_, 1}, {&own, 0}}, own.width, own.height);
    last_ = next(network_.up(l, true), first);
  }
}

void Estimate::sum_pixel(int x, int y, SampleNetwork& network) {
  const std::size_t pixel = frame_pixel(x, y);
  float context[RPF_CONTEXT];
  head(x, y, 0, RPF_CONTEXT, context);
  for (std::uint32_t i = frame_.first_sample[pixel]; i < frame_.first_sample[pixel + 1]; ++i) {
    const SeenSample& seen = network.see(i);
    const float share = frame_.weights.empty() ? 1.0F : frame_.weight(i) * plan_.weight_scale;
    const float w = network.weight(context) * share;
    const float *color = frame_.record(i),
                *other = frame_.others.data() + (i - frame_.first_record) * (plan_.carried - 3);
    const auto add = [&](std::size_t sum, float value) {
      float& s = sums_.at(y, sum)[x];
      s = fma(w, value, s);
    };
    for (std::size_t c = 0; c < 3; ++c) {
      add(RPF_SUM_RADIANCE + c, color[c]);
      add(RPF_SUM_BASE + c, seen.base[c]);
    }
    sums_.at(y, RPF_SUM_WEIGHT)[x] += w;
    for (std::size_t c = 0; c + 3 < plan_.carried; ++c) add(RPF_SUM_OTHERS + c, other[c]);
    if (!sample_weights_.empty()) {
      const std::size_t place =
          static_cast<std::size_t>(y) * static_cast<std::size_t>(window_.width) + static_cast<std::size_t>(x);
      sample_weights_[first_sample_[place] + i - frame_.first_sample[pixel]] = w;
    }
  }
}

void Estimate::sum_samples() {
  sums_ = Rows(window_.width, window_.height, kernel::rpf_sums(static_cast<uint>(plan_.carried)));
  if (stages_) sample_weights_.resize(first_sample_.back());
  const double samples = static_cast<double>(first_sample_.back()) / window_.height;
  for_rows_of_samples(samples * weighing(network_), false, [&](int y) {
    SampleNetwork network(frame_, plan_);
    with_avx2([&] {
      for (int x = 0; x < window_.width; ++x) sum_pixel(x, y, network);
    });
  });
  if (stages_) stages_->push_back({"weights", 1, std::move(sample_weights_)});
  keep("sums", sums_);
}

PassWeights Estimate::weights_of(int pass) {
  const auto embedding = static_cast<uint>(network_.embedding);
  const uint values = embedding + 1 + RPF_GUIDES, first = kernel::rpf_head_pass(static_cast<uint>(pass), embedding);
  PassWeights weights{Rows(window_.width, window_.height, embedding + RPF_GUIDES),
                      Rows(window_.width, window_.height, 1)};
  for_rows_(window_.height, window_.width * 10.0 * embedding, [&](int y) {
    std::vector<float> logits(values);
    for (int x = 0; x < window_.width; ++x) {
      head(x, y, first, values, logits.data());
      for (uint k = 0; k < embedding; ++k) weights.embedding.at(y, k)[x] = kernel::rpf_embedding(logits[k]);
      weights.own.at(y, 0)[x] = kernel::rpf_own_weight(logits[embedding]);
      for (uint k = 0; k < RPF_GUIDES; ++k)
        weights.embedding.at(y, embedding + k)[x] =
            kernel::rpf_bandwidth(logits[embedding + 1 + k]) * guides_.at(y, k)[x];
    }
  });
  return weights;
}

void Estimate::run_passes(Rows& values, int first, int end) {
  for (int pass = first; pass < end; ++pass) {
    const PassWeights weights = weights_of(pass);
    Rows means(window_.width, window_.height, values.channels);
    const double work = window_.width * passing(network_, values.channels) - window_.width * 10.0 * network_.embedding;
    for_rows_(window_.height, work, [&](int y) { filter_row(weights, network_.dilation(pass), values, y, means); });
    values = std::move(means);
    keep("pass" + std::to_string(pass), values);
  }
}

void Estimate::result_of(int x, int y, float* out) const {
  const auto sum = [&](std::size_t k) { return sums_.at(y, k)[x]; };
  const auto albedo = [&](std::size_t k) { return albedo_.at(y, k)[x]; };
  const float weight = sum(RPF_SUM_WEIGHT);
  for (std::size_t c = 3; c < plan_.carried; ++c) out[c] = kernel::rpf_over_weight(sum(RPF_SUM_OTHERS + c - 3), weight);
  float logit = 0;
  head(x, y, RPF_HEAD_BLEND, 1, &logit);
  for (std::size_t c = 0; c < 3; ++c) {
    out[c] = kernel::rpf_over_weight(sum(RPF_SUM_RADIANCE + c), weight);
    if (plan_.has_albedo)
      out[c] = kernel::rpf_blended(out[c], sum(RPF_SUM_RADIANCE + c), sum(RPF_SUM_BASE + c), albedo(c), albedo(3),
                                   kernel::rpf_blend(logit));
  }
}

std::vector<float> Estimate::results() {
  std::vector<float> pixels(window_.pixel_count() * plan_.carried);
  for_rows_(window_.height, 0, [&](int y) {
    with_avx2([&] {
      float* row =
          pixels.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(window_.width) * plan_.carried;
      for (int x = 0; x < window_.width; ++x) result_of(x, y, row + static_cast<std::size_t>(x) * plan_.carried);
    });
  });
  return pixels;
}

std::vector<float> Estimate::run() {
  keep_samples();
  run_layers();
  keep_head();
  sum_samples();
  run_passes(sums_, 0, network_.color_passes());
  keep("albedo", albedo_);
  if (plan_.has_albedo) run_passes(albedo_, network_.color_passes(), network_.passes());
  std::vector<float> pixels = results();
  if (stages_) stages_->push_back({"result", plan_.carried, pixels});
  return pixels;
}

void Estimate::keep(const std::string& name, const Field& field) {
  if (stages_) stages_->push_back({name, field.channels, field.values});
}

void Estimate::keep(const std::string& name, const Rows& rows) {
  if (!stages_) return;
  EstimateStage stage{name, rows.channels, {}};
  for (int y = 0; y < rows.height; ++y)
    for (int x = 0; x < rows.width; ++x)
      for (std::size_t c = 0; c < rows.channels; ++c) stage.values.push_back(rows.at(y, c)[x]);
  stages_->push_back(std::move(stage));
}

void Estimate::keep_samples() {
  if (!stages_) return;
  const auto features = static_cast<std::size_t>(network_.sample_features);
  EstimateStage inputs{"inputs", RPF_INPUTS, {}}, first{"sample1", features, {}}, second{"sample2", features, {}};
  SampleNetwork network(frame_, plan_);
  for (int y = 0; y < window_.height; ++y)
    for (int x = 0; x < window_.width; ++x)
      for (std::uint32_t i = frame_.first_sample[frame_pixel(x, y)]; i < frame_.first_sample[frame_pixel(x, y) + 1];
           ++i) {
        const SeenSample& seen = network.see(i);
        inputs.values.insert(inputs.values.end(), std::begin(seen.inputs), std::end(seen.inputs));
        first.values.insert(first.values.end(), seen.hidden.begin(), seen.hidden.end());
        second.values.insert(second.values.end(), seen.features.begin(), seen.features.end());
      }
  for (EstimateStage* stage : {&inputs, &first, &second}) stages_->push_back(std::move(*stage));
}

void Estimate::keep_head() {
  if (!stages_) return;
  Field all(window_.width, window_.height, static_cast<std::size_t>(network_.head().outputs));
  for (int y = 0; y < window_.height; ++y)
    for (int x = 0; x < window_.width; ++x) head(x, y, 0, static_cast<uint>(network_.head().outputs), all.at(x, y));
  keep("head", all);
}

}  // namespace rpf
