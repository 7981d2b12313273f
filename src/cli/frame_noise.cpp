#include "cli/frame_noise.h"

#include <fmt/format.h>

#include <algorithm>

#include "cli/explain_maps.h"
#include "cli/needs.h"
#include "cli/print.h"
#include "cli/progress_bar.h"
#include "rpf/explain.h"

namespace rpf::cli {
namespace {

/// Those of rpf explain, for the least work: shares depend on no box and no feature.
Settings attribution_settings(const Settings& machine) {
  Settings settings = explain_settings();
  settings.box_widths = {1};
  settings.features = std::vector<std::string>{};
  settings.backend = "cpu";  // kernels of their own would take longer to compile than this pass takes
  settings.threads = machine.threads;
  settings.max_memory = machine.max_memory;
  return settings;
}

Settings mean_settings(const Settings& machine) {
  Settings settings = attribution_settings(machine);
  settings.box_widths = {};
  settings.random = std::vector<std::string>{};
  return settings;
}

/// Why noise cannot be attributed; empty where it can.
std::string obstacle(const FilterInput& input, const Settings& settings, std::uint64_t held) {
  if (input.is_image()) return "The input is an image: it has no samples, and so no random parameters.";
  const SampleLayout layout = needed_layout(input.info, settings);
  if (std::none_of(layout.slots.begin(), layout.slots.end(), is_random_slot))
    return "The input has no random numbers of lens, time or light, so nothing tells what its noise comes from.";
  const std::uint64_t need = held + predict_explain_memory(frame_size(input.info), layout, settings);
  if (need <= settings.max_memory) return "";
  return fmt::format("Left out: it would take {:.0f} MB of memory, the limit is {:.0f} MB (--max-memory).",
                     static_cast<double>(need) / megabyte, static_cast<double>(settings.max_memory) / megabyte);
}

SampleBuffer read_needed(const FilterInput& input, const Settings& settings, SampleReadOptions read) {
  read.slots = needed_layout(input.info, settings).slots;
  return read_input(input, read);
}

std::vector<NoisePart> noise_parts(const Explanation& explanation) {
  const Image& layers = explanation.layers;
  std::vector<NoisePart> parts;
  for (const std::string& group : explanation.groups) parts.push_back({group, 0, 0});
  const std::size_t share = channel_of(layers, "share." + parts.front().group),
                    explained = channel_of(layers, "share.explained"), error = channel_of(layers, "noise.mean");
  double variance = 0;
  const std::size_t pixels = layers.data_window.pixel_count();
  for (std::size_t p = 0; p < pixels; ++p) {
    const float* values = layers.pixel(p);
    const double here = static_cast<double>(values[error]) * values[error];
    variance += here;
    for (std::size_t g = 0; g < parts.size(); ++g) parts[g].of_noise += here * values[explained] * values[share + g];
    const float* largest = std::max_element(values + share, values + share + parts.size());
    if (*largest > 0) parts[static_cast<std::size_t>(largest - values) - share].of_pixels += 1;
  }
  for (NoisePart& part : parts) {
    if (variance > 0) part.of_noise /= variance;
    part.of_pixels /= static_cast<double>(pixels);
  }
  return parts;
}

/// The picture of rpf explain, and behind its colors the groups' shares.
report::ViewerLayer layer_of(const Explanation& explanation) {
  ExplainMap map = attribution_map(explanation);
  Image image = explanation.layers;
  image.channels = map.picture.channels;
  image.channels.insert(image.channels.end(), explanation.groups.begin(), explanation.groups.end());
  image.pixels.clear();
  const std::size_t share = channel_of(explanation.layers, "share." + explanation.groups.front());
  for (std::size_t p = 0; p < image.data_window.pixel_count(); ++p) {
    const float *color = map.picture.pixel(p), *shares = explanation.layers.pixel(p) + share;
    image.pixels.insert(image.pixels.end(), color, color + map.picture.channel_count());
    image.pixels.insert(image.pixels.end(), shares, shares + explanation.groups.size());
  }
  return {"where the noise comes from", report::LayerKind::color, std::move(image), std::move(map.legend)};
}

}  // namespace

FrameNoise measure_noise(const FilterInput& input, const FramePageJob& job, std::uint64_t held) {
  const Settings settings = attribution_settings(job.machine);
  FrameNoise noise;
  noise.missing = obstacle(input, settings, held);
  if (!noise.missing.empty()) {
    const Settings plain = mean_settings(job.machine);
    const Result result = filter(read_needed(input, plain, job.read), plain);
    noise.mean = part_of(result.image, "R", {"R", "G", "B"});
    noise.notes = result.report.notes;
    return noise;
  }
  if (job.progress != "never")
    remark("rpf: attributing the noise of {} samples to random parameters\n", input.info.sample_count);
  SampleBuffer samples = read_needed(input, settings, job.read);
  const Explanation explanation = with_progress(
      job.progress, [&](const Control& control) { return explain(std::move(samples), settings, control); });
  noise.mean = part_of(explanation.layers, "R", {"R", "G", "B"});
  noise.notes = explanation.report.notes;
  noise.seconds = explanation.report.seconds;
  if (explanation.groups.empty()) {
    noise.missing =
        "The random parameters of the input are the same for all samples, so nothing tells where its noise is from.";
    return noise;
  }
  noise.layer = layer_of(explanation);
  noise.parts = noise_parts(explanation);
  return noise;
}

}  // namespace rpf::cli
