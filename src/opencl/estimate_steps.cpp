#include "opencl/estimate_steps.h"

#include <algorithm>

#include "network_launch.h"
#include "opencl/layer_blocking.h"

namespace rpf {
namespace {

using Kind = EstimateStep::Kind;
using kernel::uint;

/// Rows that a step makes at once: enough work for a launch, and little enough that what one step writes is still in
/// the processor's caches for the next. Passes read many rows around, so that few of them at once would be read over
/// and over.
constexpr int cells_at_once = 16384, most_rows_at_once = 64, pass_rows_at_once = 32, least_rows_at_once = 8;

int rows_at_once(Kind kind, int width, int level) {
  if (kind == Kind::pass || kind == Kind::finish) return pass_rows_at_once;  // the latter asks for rows of the former
  return std::clamp(cells_at_once / width, least_rows_at_once,
                    std::max(most_rows_at_once >> level, least_rows_at_once));
}

/// What is kept of samples stays in large caches; where it would take more it is cheaper to compute it once more.
constexpr double most_kept_bytes = 128 << 20;
/// Of a sample: its features and what is summed.
int kept_floats(const Network& network) { return padded(network.sample_features) + RPF_SEEN - RPF_SEEN_SUMMED; }
double bytes_kept(const EstimatePlan& plan, double samples) {
  return samples * kept_floats(*plan.network) * static_cast<double>(sizeof(float));
}

int whole(int count, int unit) { return (count + unit - 1) / unit * unit; }

double products(const NetworkLayer& layer) { return static_cast<double>(layer.inputs) * layer.outputs * layer.taps; }

/// Builds the lists.
class Builder {
 public:
  /// `whole_head`: keeps what the first layer reads, and all that the head says, also what the result does not need.
  Builder(EstimateSteps& steps, const EstimatePlan& plan, const Window& window, double samples, bool whole_head,
          int row_samples)
      : out_(steps),
        plan_(plan),
        network_(*plan.network),
        window_(window),
        samples_(samples / window.height),
        whole_head_(whole_head),
        row_samples_(row_samples) {}

  void build() {
    const int last = layers(see());
    out_.heads = head(last);
    std::vector<int> summed = {out_.heads};
    if (out_.kept >= 0) summed.push_back(out_.kept);
    const int sums = make(Kind::sum, 0, summed, planes("sums", sum_count()), 0, samples_ * sum_work());
    const int color_passes = network_.color_passes(), filtered = passes(last, sums, 0, color_passes);
    const int albedo = plan_.has_albedo ? passes(last, out_.albedo, color_passes, network_.passes()) : out_.albedo;
    EstimateGrid result = planes("result", static_cast<int>(plan_.carried));
    result.stored = 0;  // the host has it
    std::vector<int> read = {filtered, albedo, out_.heads};
    for (int pass = color_passes; whole_head_ && !plan_.has_albedo && pass < network_.passes(); ++pass)
      read.push_back(embed(last, pass));
    out_.result = make(Kind::finish, 0, read, result, 0, 30.0 * window_.width);
  }

 private:
  int sum_count() const { return static_cast<int>(kernel::rpf_sums(static_cast<uint>(plan_.carried))); }
  double sample_work() const { return products(network_.sample1()) + products(network_.sample2()) + 500; }
  double sum_work() const {
    return (out_.kept >= 0 ? 300 : sample_work()) + products(network_.weight1()) + products(network_.weight2());
  }

  int size_at(int size, int level) const { return (size + (1 << level) - 1) >> level; }
  EstimateGrid cells(const std::string& name, int values, int level) const {
    return {name, size_at(window_.width, level), size_at(window_.height, level), values, padded(values), false};
  }
  EstimateGrid planes(const std::string& name, int values) const {
    return {name, window_.width, window_.height, values, values, true};
  }

  int add(const EstimateGrid& grid) {
    out_.grids.push_back(grid);
    return out_.pipeline.add_grid(grid.height);
  }

  /// What a step reads of the first of its grids, or of the others. A pixel and another one weigh the same in each
  /// other's mean: only the pairs with those further on are made, and passes look for the others further back.
  RowPipeline::Read read(Kind kind, int number, int grid, bool is_first) const {
    if (kind == Kind::layer) {
      const int around = network_.layers[static_cast<std::size_t>(number)].taps == 9 ? 1 : 0;
      return {grid, around, around};
    }
    const int reach = kind == Kind::weigh || kind == Kind::pass ? RPF_PASS_REACH * network_.dilation(number) : 0;
    return {grid, kind == Kind::pass ? reach : 0, kind == Kind::weigh || is_first ? reach : 0};
  }

  int make(Kind kind, int number, const std::vector<int>& in, const EstimateGrid& grid, int level, double row_work) {
    return make_all(kind, number, in, {add(grid)}, level, row_work);
  }

  /// Returns the first grid.
  int make_all(Kind kind, int number, const std::vector<int>& in, const std::vector<int>& out, int level,
               double row_work) {
    std::vector<RowPipeline::Read> reads;
    for (const int grid : in) {
      const bool is_first = grid == in.front(), coarser = kind == Kind::layer && in.size() > 1 && is_first;
      reads.push_back(read(kind, number, grid, is_first));
      reads.back().octave = kind == Kind::halve ? 1 : coarser ? -1 : 0;
    }
    const int width = out_.grids[static_cast<std::size_t>(out.front())].width;
    out_.pipeline.add_step(out, reads, rows_at_once(kind, width, level));
    out_.steps.push_back({kind, number, level, in, out, row_work});
    return out.front();
  }

  int see() {
    const NetworkLayer& enter = network_.enter();
    if (whole_head_) out_.pixel = add(cells("pixel", enter.inputs, 0));
    out_.enter = add(cells(enter.name, enter.outputs, 0));
    out_.guides = add(planes("guides", RPF_GUIDES));
    out_.albedo = add(planes("albedo", RPF_ALBEDO_SUMS));
    std::vector<int> made = {out_.enter, out_.guides, out_.albedo};
    if (whole_head_) made.push_back(out_.pixel);
    if (row_samples_ > 0) {
      const int stored = kept_floats(network_);
      made.push_back(out_.kept = add({"", row_samples_, window_.height, stored, stored, false}));
    }
    return make_all(Kind::see, 0, {}, made, 0, samples_ * sample_work() + window_.width * products(enter));
  }

  int layer(const NetworkLayer& layer, const std::vector<int>& in, int level) {
    const EstimateGrid grid = cells(layer.name, layer.outputs, level);
    return make(Kind::layer, static_cast<int>(&layer - network_.layers.data()), in, grid, level,
                grid.width * products(layer));
  }

  int layers(int entered) {
    std::vector<int> levels = {layer(network_.down(0, false), {entered}, 0)};
    for (int l = 1; l < network_.levels(); ++l) {
      const int channels = network_.channels[static_cast<std::size_t>(l - 1)];
      const int half = make(Kind::halve, 0, {levels.back()}, cells("", channels, l), l, 0);
      levels.push_back(layer(network_.down(l, true), {layer(network_.down(l, false), {half}, l)}, l));
    }
    int last = levels.back();
    for (int l = network_.levels() - 2; l >= 0; --l)
      last = layer(network_.up(l, true), {layer(network_.up(l, false), {last, levels[static_cast<std::size_t>(l)]}, l)},
                   l);
    return last;
  }

  /// Context and blend.
  int head(int last) {
    const int values = RPF_CONTEXT + 1;
    return make(Kind::head, 0, {last}, cells("", values, 0), 0, 1.0 * window_.width * network_.channels[0] * values);
  }

  int embed(int last, int pass) {
    const int terms = network_.embedding + RPF_GUIDES;
    std::vector<int> made = {add(planes("", terms + 1))};
    if (whole_head_) made.push_back(add(planes("", terms + 1)));
    return make_all(Kind::embed, pass, {last, out_.guides}, made, 0,
                    window_.width * (1.0 * network_.channels[0] * (terms + 1) + 10.0 * terms));
  }

  int passes(int last, int values, int first, int end) {
    for (int pass = first; pass < end; ++pass) {
      const int terms = network_.embedding + RPF_GUIDES, kept = out_.grids[static_cast<std::size_t>(values)].values;
      const int embedded = embed(last, pass);
      const int weights = make(Kind::weigh, pass, {embedded}, planes("", RPF_PASS_PAIRS + 1), 0,
                               1.0 * RPF_PASS_PAIRS * window_.width * (terms + 15));
      // Values first: they come from the samples, which may be gone by the time that all weights are there.
      values = make(Kind::pass, pass, {values, weights}, planes("pass" + std::to_string(pass), kept), 0,
                    25.0 * window_.width * (1 + kept));
    }
    return values;
  }

  EstimateSteps& out_;
  const EstimatePlan& plan_;
  const Network& network_;
  Window window_;
  double samples_;  ///< a row
  bool whole_head_;
  int row_samples_;
};

}  // namespace

int EstimateGrid::pitch() const {
  if (!planes) return stored * (whole(width, RPF_CELLS) + 2 * RPF_BORDER);
  // An odd number of cache lines: planes that are powers of two apart would share a few sets of the cache.
  const int lines = whole(width, RPF_LANES) / RPF_LANES + 2 * RPF_MARGIN / RPF_LANES;
  return stored * RPF_LANES * (lines % 2 == 0 ? lines + 1 : lines);
}

EstimateSteps::EstimateSteps(const EstimatePlan& plan, const Window& window, double samples, int first, int end,
                             bool keep_all, int row_samples) {
  Builder(*this, plan, window, samples, keep_all, row_samples).build();
  pipeline.plan(result, first, end, keep_all);
  if (kept >= 0 && bytes_kept(plan, 1.0 * row_samples * pipeline.rows(kept)) > most_kept(plan, samples))
    *this = EstimateSteps(plan, window, samples, first, end, keep_all);
}

double EstimateSteps::most_kept(const EstimatePlan& plan, double samples) {
  return std::min(most_kept_bytes, bytes_kept(plan, samples));
}

double EstimateSteps::work() const {
  double sum = 0;
  for (std::size_t i = 0; i < steps.size(); ++i) sum += steps[i].row_work * pipeline.made(static_cast<int>(i));
  return sum;
}

std::uint64_t EstimateSteps::bytes() const {
  std::uint64_t sum = 0;
  for (std::size_t i = 0; i < grids.size(); ++i)
    sum += sizeof(float) * static_cast<std::uint64_t>(grids[i].pitch()) *
           static_cast<std::uint64_t>(pipeline.rows(static_cast<int>(i)));
  return sum;
}

}  // namespace rpf
