// A small frame through the whole filter or explained, once with each backend: pixels, report and errors must be the
// same, bit for bit.
#include <array>
#include <cmath>
#include <csignal>
#include <cstdint>
#include <cstring>
#include <optional>

#include "filter_input.h"
#include "must_hold.h"
#include "rpf/error.h"
#include "rpf/filter.h"

namespace {

/// libFuzzer's handlers, which keep the input of a crash. PoCL's compiler puts its own in their place.
class CrashHandlers {
 public:
  CrashHandlers() {
    for (std::size_t i = 0; i < signals.size(); ++i) ::sigaction(signals[i], nullptr, &actions_[i]);
  }
  void restore() const {
    for (std::size_t i = 0; i < signals.size(); ++i) ::sigaction(signals[i], &actions_[i], nullptr);
  }

 private:
  static constexpr std::array<int, 5> signals = {SIGABRT, SIGSEGV, SIGBUS, SIGILL, SIGTRAP};
  std::array<struct sigaction, signals.size()> actions_{};
};

/// What a run leaves: an error's text and kind, or a result. Of an explanation the layers are the image.
struct Outcome {
  std::string error;
  rpf::Result result;
  std::optional<rpf::ExplainedPixel> pixel;
};

Outcome run(const FilterInput& input, const char* backend) {
  Outcome outcome;
  rpf::Settings settings = input.settings;
  settings.backend = backend;
  try {
    if (input.explains) {
      rpf::Explanation explanation = rpf::explain(input.samples, settings, {}, input.pixel);
      outcome.result.image = std::move(explanation.layers);
      outcome.result.report = std::move(explanation.report);
      outcome.pixel = std::move(explanation.pixel);
    } else {
      outcome.result = rpf::filter(input.samples, settings);
    }
  } catch (const rpf::Error& error) {
    outcome.error = std::to_string(static_cast<int>(error.kind())) + " " + error.what();
    must_hold(error.kind() == rpf::ErrorKind::usage || error.kind() == rpf::ErrorKind::input,
              backend + (" fails: " + outcome.error));
  }
  return outcome;
}

/// The same values; NaN equals NaN, 0 is not -0.
template <class Float>
void expect_same(const std::vector<Float>& a, const std::vector<Float>& b, const std::string& what) {
  must_hold(a.size() == b.size(), what + ": sizes");
  for (std::size_t i = 0; i < a.size(); ++i) {
    const bool same = std::memcmp(&a[i], &b[i], sizeof(Float)) == 0 || (std::isnan(a[i]) && std::isnan(b[i]));
    char values[80];
    std::snprintf(values, sizeof values, "[%zu]: cpu %a, opencl %a", i, static_cast<double>(a[i]),
                  static_cast<double>(b[i]));
    must_hold(same, what + values);
  }
}

void expect_same(const rpf::Image& a, const rpf::Image& b, const std::string& what) {
  must_hold(a.channels == b.channels && a.data_window == b.data_window, what + ": channels and window");
  expect_same(a.pixels, b.pixels, what);
}

std::vector<double> numbers_of(const rpf::PassReport& p) {
  return {static_cast<double>(p.box_width), p.neighbors, p.acceptance, p.fraction_random, p.alpha, p.beta, p.energy};
}

void expect_same(const rpf::Report& a, const rpf::Report& b) {
  must_hold(a.random == b.random && a.features == b.features && a.dropped == b.dropped, "channels of the report");
  must_hold(a.notes.size() == b.notes.size() && a.passes.size() == b.passes.size(), "sizes of the report");
  for (std::size_t i = 0; i < a.notes.size(); ++i) {
    const rpf::InputNote &m = a.notes[i], &n = b.notes[i];
    must_hold(m.what == n.what && m.count == n.count && m.x == n.x && m.y == n.y, "note: " + m.what);
  }
  for (std::size_t i = 0; i < a.passes.size(); ++i)
    expect_same(numbers_of(a.passes[i]), numbers_of(b.passes[i]), "report of pass " + std::to_string(i));
}

std::vector<float> numbers_of(const rpf::ExplainedPixel& pixel) {
  std::vector<float> numbers{pixel.fraction_random, pixel.effective_samples};
  for (const rpf::ExplainedNeighbor& n : pixel.neighbors) numbers.insert(numbers.end(), {n.share, n.color[0]});
  for (const rpf::ExplainedPair& p : pixel.pairs) numbers.push_back(p.information);
  for (const rpf::ExplainedColor& c : pixel.colors) numbers.insert(numbers.end(), {c.alpha, c.fraction_random});
  for (const rpf::ExplainedFeature& f : pixel.features) numbers.insert(numbers.end(), {f.beta, f.fraction_feature});
  return numbers;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  static const CrashHandlers handlers;
  const FilterInput input = filter_input(data, size);
  const Outcome reference = run(input, "cpu"), device = run(input, "opencl");
  handlers.restore();
  must_hold(reference.error == device.error, "errors: cpu '" + reference.error + "', opencl '" + device.error + "'");
  expect_same(reference.result.image, device.result.image, "image");
  expect_same(reference.result.report, device.result.report);
  must_hold(reference.pixel.has_value() == device.pixel.has_value(), "one explains a pixel");
  if (reference.pixel) expect_same(numbers_of(*reference.pixel), numbers_of(*device.pixel), "explained pixel");
  if (input.explains) return 0;
  for (const float value : reference.result.image.pixels) must_hold(std::isfinite(value), "finite pixels");
  return 0;
}
