#include "filter_input.h"

#include <array>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

namespace {

constexpr std::uint32_t varying = 0;

/// What is compiled into the kernel. Missing values and samples left out make up to four kernels of each.
struct Kind {
  std::vector<std::string> slots;  ///< beside R, G, B, film.X and film.Y
  std::vector<std::string> random;
  std::uint32_t samples;
  int bins;
};

const std::vector<Kind>& kinds() {
  static const std::vector<Kind> list = {
      {{"random.lens.U", "random.lens.V", "random.time", "feature.N.X", "feature.N.Y", "feature.N.Z", "feature.P.X",
        "feature.P.Y", "feature.P.Z"},
       {"lens", "time"},
       4,
       7},
      {{"A", "weight", "random.light.U", "feature.P.X", "feature.P.Y", "feature.P.Z", "feature.P2.X", "feature.hit"},
       {"light", "pixel"},
       varying,
       5},
      {{"random.lens.U"}, {"lens"}, 1, 3}};
  return list;
}

/// The fuzzer's bytes, then a fixed sequence.
class Bytes {
 public:
  Bytes(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  std::uint8_t byte() {
    if (at_ < size_) return data_[at_++];
    state_ = state_ * 1664525U + 1013904223U;
    return static_cast<std::uint8_t>((state_ >> 24) % plain_values);
  }
  std::uint32_t word() {
    std::uint32_t bits = 0;
    for (int i = 0; i < 4; ++i) bits = bits << 8 | byte();
    return bits;
  }
  template <class T, std::size_t n>
  T one_of(const std::array<T, n>& list) {
    return list[byte() % n];
  }
  bool flag(unsigned one_in) { return byte() % one_in == one_in - 1; }

  /// Mostly in [0, 1); sometimes an extreme, sometimes any 32 bits.
  float value() {
    using Limits = std::numeric_limits<float>;
    static const std::array<float, 20> extremes = {Limits::quiet_NaN(),
                                                   Limits::infinity(),
                                                   -Limits::infinity(),
                                                   0.0F,
                                                   -0.0F,
                                                   Limits::denorm_min(),
                                                   -1e-42F,
                                                   Limits::min(),
                                                   Limits::max(),
                                                   Limits::lowest(),
                                                   1e-30F,
                                                   1e15F,
                                                   1e16F,
                                                   1e30F,
                                                   -1e30F,
                                                   -1.0F,
                                                   1.0F,
                                                   0.99999994F,
                                                   1e7F,
                                                   123456.0F};
    const std::size_t choice = byte();
    if (choice < plain_values) return static_cast<float>(choice) / plain_values + static_cast<float>(byte()) * 1e-5F;
    if (choice - plain_values < extremes.size()) return extremes[choice - plain_values];
    const std::uint32_t bits = word();
    float any = 0;
    std::memcpy(&any, &bits, sizeof any);
    return any;
  }

 private:
  static constexpr std::size_t plain_values = 200;

  const std::uint8_t* data_;
  std::size_t size_, at_ = 0;
  std::uint32_t state_ = 1;
};

rpf::Settings settings_of(Bytes& bytes, const Kind& kind) {
  rpf::Settings s;
  s.random = kind.random;
  s.bins = kind.bins;
  s.threads = 1;
  s.box_widths.clear();
  for (int passes = bytes.byte() % 4; passes > 0; --passes)
    s.box_widths.push_back(bytes.one_of(std::array<int, 8>{1, 3, 3, 5, 7, 9, 15, 256}));
  s.profile = bytes.flag(2) ? rpf::Profile::paper : rpf::Profile::thesis;
  if (bytes.flag(2)) s.samples_factor = bytes.one_of(std::array<double, 6>{0, 0.01, 0.5, 1, 2, -1});
  s.max_samples = bytes.one_of(std::array<std::uint32_t, 7>{0, 0, 1, 3, 17, 65, 129});
  s.seed = bytes.word();
  s.redraws = bytes.one_of(std::array<int, 5>{8, 8, 0, 15, 16});
  if (bytes.flag(4)) s.noise = bytes.value();
  if (bytes.flag(4)) s.alpha_factor = bytes.value();
  if (bytes.flag(4)) s.position_scale = bytes.value();
  s.bias_correction = bytes.flag(2);
  s.clamp_negative = bytes.flag(2);
  return s;
}

/// What the light field asks for beside positions, which some frames have: how surfaces move, and a camera, mostly one
/// that there can be.
void add_light_field(Bytes& bytes, rpf::SampleBuffer& samples) {
  const std::size_t columns = samples.layout.size();
  std::vector<float> values;
  for (std::size_t sample = 0; sample < samples.sample_count(); ++sample) {
    const auto record = samples.values.begin() + static_cast<std::ptrdiff_t>(sample * columns);
    values.insert(values.end(), record, record + static_cast<std::ptrdiff_t>(columns));
    for (int added = 0; added < 6; ++added) values.push_back(bytes.value());
  }
  samples.values = std::move(values);
  for (const char* group : {"feature.opening.", "feature.closing."})
    for (const char* axis : {"X", "Y", "Z"}) samples.layout.slots.push_back(std::string(group) + axis);
  std::vector<float> to_camera = {1, 0, 0, 0, 0, -1, 0, 0, 0, 0, 1, 0, 0, 0, 2, 1},
                     to_ndc = {1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 0, 1, 0, 0, 0, 2};
  for (std::vector<float>* matrix : {&to_camera, &to_ndc})
    if (bytes.flag(4)) (*matrix)[bytes.byte() % matrix->size()] = bytes.value();
  samples.metadata["worldToCamera"] = to_camera;
  samples.metadata["worldToNDC"] = to_ndc;
  samples.metadata["rpf:lensRadius"] = bytes.value();
  samples.metadata["rpf:focusDistance"] = bytes.flag(4) ? bytes.value() : 3.0F;
}

/// One of the methods with fixed weights, which are compiled from box.cl, or of those of the whole frame.
void choose_method(Bytes& bytes, FilterInput& input) {
  rpf::Settings& s = input.settings;
  s.method = bytes.one_of(std::array<rpf::Method, 9>{
      rpf::Method::gaussian, rpf::Method::bilateral, rpf::Method::cross_bilateral, rpf::Method::nlm, rpf::Method::gem,
      rpf::Method::sbf, rpf::Method::axis_aligned, rpf::Method::lightfield, rpf::Method::multidim});
  if (s.method == rpf::Method::lightfield) add_light_field(bytes, input.samples);
  s.views = 7;
  if (bytes.flag(2)) s.sigma_color = bytes.value();
  if (bytes.flag(2)) s.sigma_feature = bytes.value();
}

/// Mostly what explain() takes.
void choose_explanation(Bytes& bytes, FilterInput& input) {
  input.explains = true;
  if (!bytes.flag(8)) input.settings.box_widths = {3 + 2 * (bytes.byte() % 4)};
  if (!bytes.flag(8)) input.settings.crop.reset();
  const rpf::Window& frame = input.samples.data_window;
  if (bytes.flag(2)) input.pixel = {frame.x + bytes.byte() % 9, frame.y + bytes.byte() % 7};
}

rpf::Window window_of(Bytes& bytes) {
  static const std::array<rpf::Window, 4> places = {
      rpf::Window{0, 0, 0, 0}, {-7, -3, 0, 0}, {100000, 5, 0, 0}, {0, -1, 0, 0}};
  rpf::Window window = bytes.one_of(places);
  window.width = 2 + bytes.byte() % 9;
  window.height = 1 + bytes.byte() % 7;
  return window;
}

/// Counts vary even where the fuzzer chooses the same one everywhere.
std::uint32_t count_of(Bytes& bytes, const Kind& kind, std::size_t pixel) {
  if (kind.samples != varying) return kind.samples;
  return pixel < 2 ? static_cast<std::uint32_t>(2 - pixel) : bytes.byte() % 7U;
}

rpf::SampleBuffer samples_of(Bytes& bytes, const Kind& kind) {
  rpf::SampleBuffer samples;
  samples.data_window = samples.display_window = window_of(bytes);
  samples.layout.slots = {"R", "G", "B", "film.X", "film.Y"};
  samples.layout.slots.insert(samples.layout.slots.end(), kind.slots.begin(), kind.slots.end());
  samples.first_sample.push_back(0);
  const auto width = static_cast<std::size_t>(samples.data_window.width);
  for (std::size_t pixel = 0; pixel < samples.data_window.pixel_count(); ++pixel) {
    const std::uint32_t count = count_of(bytes, kind, pixel);
    for (std::uint32_t i = 0; i < count; ++i) {
      const std::size_t sample = samples.first_sample.back() + i;
      for (std::size_t column = 0; column < samples.layout.size(); ++column) {
        float value = sample < 2 ? (sample == 0 ? 0.25F : 0.75F) : bytes.value();
        if (column == 3) value += static_cast<float>(samples.data_window.x + static_cast<int>(pixel % width));
        if (column == 4) value += static_cast<float>(samples.data_window.y + static_cast<int>(pixel / width));
        samples.values.push_back(value);
      }
    }
    samples.first_sample.push_back(samples.first_sample.back() + count);
  }
  return samples;
}

rpf::Window crop_of(Bytes& bytes, const rpf::Window& frame) {
  return {frame.x + bytes.byte() % frame.width, frame.y + bytes.byte() % frame.height, bytes.byte() % 5,
          bytes.byte() % 5};
}

}  // namespace

FilterInput filter_input(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const Kind& kind = kinds()[bytes.byte() % kinds().size()];
  FilterInput input;
  input.settings = settings_of(bytes, kind);
  const bool crops = bytes.flag(4), breaks = bytes.flag(16);
  input.samples = samples_of(bytes, kind);
  if (crops) input.settings.crop = crop_of(bytes, input.samples.data_window);
  if (bytes.flag(3)) choose_method(bytes, input);
  if (bytes.flag(3)) choose_explanation(bytes, input);
  if (breaks) input.samples.first_sample[bytes.byte() % input.samples.first_sample.size()] = bytes.byte();
  return input;
}
