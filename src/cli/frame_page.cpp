#include "cli/frame_page.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <filesystem>

#include "cli/explain_maps.h"
#include "cli/frame_noise.h"
#include "cli/measuring.h"
#include "cli/needs.h"
#include "cli/print.h"
#include "cli/signals.h"
#include "report/heat_map.h"
#include "report/html_page.h"
#include "report/viewer.h"
#include "rpf/error.h"
#include "rpf/methods.h"
#include "rpf/metrics.h"
#include "rpf/outputs.h"

namespace rpf::cli {
namespace {

namespace fs = std::filesystem;

std::string name_of_file(const std::string& path) { return fs::path(path).filename().string(); }

std::string in_megabytes(std::uint64_t bytes) {
  return fmt::format("{:.0f} MB", static_cast<double>(bytes) / megabyte);
}

/// The part of an image in a window of the same coordinates.
Image cropped(const Image& image, const Window& window) {
  Image part = image;
  part.data_window = window;
  part.pixels.clear();
  const std::size_t channels = image.channel_count(), row = static_cast<std::size_t>(window.width) * channels;
  for (int y = 0; y < window.height; ++y) {
    const auto first = static_cast<std::size_t>(window.y - image.data_window.y + y) * image.data_window.width +
                       static_cast<std::size_t>(window.x - image.data_window.x);
    part.pixels.insert(part.pixels.end(), image.pixel(first), image.pixel(first) + row);
  }
  return part;
}

bool lies_inside(const Window& part, const Window& whole) {
  return part.x >= whole.x && part.y >= whole.y && part.x + part.width <= whole.x + whole.width &&
         part.y + part.height <= whole.y + whole.height;
}

/// Everything that the page shows.
class FramePage {
 public:
  explicit FramePage(const FramePageJob& job)
      : job_(job),
        input_(open_input(job.input, Method::gaussian, job.read)),
        page_(fmt::format("{}, before and after", name_of_file(job.input))) {
    const std::uint64_t limit = job.machine.max_memory;
    check_need(input_.info, "the page", std::max(page_bytes(input_.info, !job.reference.empty()), input_.image_bytes),
               limit);
    after_ = read_image(job.output, limit);
    if (!job.reference.empty()) reference_ = read_image(job.reference, limit);
    check_window();
    if (job.progress != "never") tell_display_windows();
    // What is wrong with the images is told before the noise is measured, which takes long.
    filtered_ = light("filtered", job.output, after_);
    if (reference_) after_errors_ = errors_of(job.output, after_);
    noise_ = measure_noise(input_, job, image_bytes(after_) + (reference_ ? image_bytes(*reference_) : 0));
    window_ = is_whole() ? input_.info.data_window : after_.data_window;
    noise_.mean = cropped(noise_.mean, window_);
    if (noise_.layer) noise_.layer->image = cropped(noise_.layer->image, window_);
  }

  void write() {
    page_.paragraph(fmt::format("The plain mean of the samples of {} beside {}.", name_of_file(job_.input),
                                name_of_file(job_.output)));
    add_viewer();
    add_errors();
    add_noise();
    add_settings();
    add_run();
    add_data();
    const SignalGuard guard;  // a signal now waits until the page is whole
    page_.write(job_.page);
  }

 private:
  /// Formats without windows put every image's first pixel at 0,0.
  bool is_whole() const {
    return after_.data_window.width == input_.info.data_window.width &&
           after_.data_window.height == input_.info.data_window.height;
  }

  void check_window() const {
    if (is_whole() || lies_inside(after_.data_window, input_.info.data_window)) return;
    throw Error(ErrorKind::input,
                fmt::format("\"{}\" has the data window {}, which is no part of \"{}\" with {}; name "
                            "the image that was made of these samples",
                            job_.output, text_of(after_.data_window), job_.input, text_of(input_.info.data_window)));
  }

  /// Formats without windows have none to tell.
  void tell_display_windows() const {
    const Window& shown = after_.display_window;
    if (is_openexr(job_.output)) tell_display_window(job_.output, shown, "its input", input_.info.display_window);
    if (reference_) tell_display_window(job_.output, shown, "its reference", reference_->display_window);
  }

  report::ViewerLayer light(const std::string& name, const std::string& file, const Image& image) const {
    Image rgb = measuring(file, job_.input, [&] { return rgb_of(image); });
    rgb.data_window = window_;
    return {name, report::LayerKind::light, std::move(rgb)};
  }

  static Image rgb_of(const Image& image) {
    Image rgb = image;
    rgb.channels = {"R", "G", "B"};
    rgb.pixels.clear();
    std::vector<std::size_t> channels;
    for (const std::string& name : rgb.channels) {
      channels.push_back(channel_of(image, name));
      if (channels.back() == image.channel_count()) throw Error(ErrorKind::input, "it has no channel " + name);
    }
    for (std::size_t p = 0; p < image.data_window.pixel_count(); ++p)
      for (const std::size_t channel : channels) rgb.pixels.push_back(image.pixel(p)[channel]);
    return rgb;
  }

  report::ViewerLayer difference(const std::string& name, const std::string& file, const Image& image,
                                 const std::string& base_file, const Image& base) const {
    const auto text = [](double value) { return fmt::format("{:g}", value); };
    Image map = measuring(file, base_file, [&] { return relative_error_map(image, base); });
    return {name, report::LayerKind::error, std::move(map),
            report::magma_legend(text(report::darkest_error), text(report::brightest_error) + ", logarithmic")};
  }

  void add_viewer() {
    report::Viewer viewer;
    viewer.layers.push_back(light("plain mean", job_.input, noise_.mean));
    filtered_.image.data_window = window_;
    viewer.layers.push_back(std::move(filtered_));
    if (reference_) viewer.layers.push_back(light("reference", job_.reference, *reference_));
    viewer.layers.push_back(difference("what the filter changed", job_.output, after_, job_.input, noise_.mean));
    if (reference_) {
      viewer.layers.push_back(difference("error before", job_.input, noise_.mean, job_.reference, *reference_));
      viewer.layers.push_back(difference("error after", job_.output, after_, job_.reference, *reference_));
    }
    if (noise_.layer) viewer.layers.push_back(std::move(*noise_.layer));
    const bool exact = report::is_exact(viewer);
    page_.viewer(viewer);
    page_.paragraph(
        fmt::format("Pixels count as in the files; {}. Differences and errors are the mean over R, G, B of "
                    "(a - b)\u00b2 / (b\u00b2 + 0.01), as rpf compare --diff draws them.",
                    exact ? "the values are those of the files to the last bit, told with six digits"
                          : "the values are those of the files with four digits"));
  }

  void add_errors() {
    page_.heading("Errors");
    if (!reference_)
      return page_.paragraph("Without a reference nobody knows: rpf report IN OUT REFERENCE -o page.html.");
    page_.paragraph("Against " + name_of_file(job_.reference) + "; docs/commands.md has the definitions.");
    const std::vector<double> before = errors_of(job_.input, noise_.mean);
    report::Table table{{"error", "plain mean", "filtered"}, {}, 1};
    const char* names[] = {"relMSE", "trimmed relMSE", "MSE", "MAE", "energy", "PSNR", "SSIM", "FLIP", "HDR-FLIP"};
    for (std::size_t i = 0; i < before.size(); ++i)
      table.rows.push_back({names[i], fmt::format("{:.4g}", before[i]), fmt::format("{:.4g}", after_errors_[i])});
    page_.table(table);
  }

  std::vector<double> errors_of(const std::string& file, const Image& image) const {
    const ImageError e = measuring(file, job_.reference, [&] { return compare_images(image, *reference_); });
    return {e.relmse, e.trimmed_relmse, e.mse, e.mae, e.energy, e.psnr, e.ssim, e.flip, e.hdr_flip};
  }

  void add_noise() {
    page_.heading("Where the noise comes from");
    if (!noise_.missing.empty()) return page_.paragraph(noise_.missing);
    page_.paragraph(
        fmt::format("What each random parameter alone decides, of the variance of the plain mean; measured on the "
                    "samples in {:.1f} s (rpf explain has more, docs/explain.md how far to trust it). The layer "
                    "\"where the noise comes from\" shows it pixel by pixel.",
                    noise_.seconds));
    report::Table table{{"random parameter", "of the frame's noise", "pixels where it is first"}, {}, 1};
    double rest = 1;
    const auto percent = [](double part) { return fmt::format("{:.1f} %", 100 * part); };
    for (const NoisePart& part : noise_.parts) {
      table.rows.push_back({part.group, percent(part.of_noise), percent(part.of_pixels)});
      rest -= part.of_noise;
    }
    table.rows.push_back({"others, or several together", percent(std::max(rest, 0.0)), ""});
    page_.table(table);
  }

  void add_settings() {
    page_.heading("Settings");
    report::Table table{{"attribute of " + name_of_file(job_.output), "value"}, {}, 2};
    for (const auto& [name, value] : after_.metadata)
      if (name.rfind("rpf:", 0) == 0) table.rows.push_back({name.substr(4), text_of_attribute(value)});
    if (table.rows.empty())
      return page_.paragraph(
          "The image does not say how it was made: its format holds no attributes, or another program made it.");
    page_.table(table);
  }

  static std::string text_of_attribute(const Attribute& attribute) {
    if (const auto* text = std::get_if<std::string>(&attribute)) return *text;
    if (const auto* number = std::get_if<std::int32_t>(&attribute)) return fmt::format("{}", *number);
    if (const auto* number = std::get_if<float>(&attribute)) return fmt::format("{}", *number);
    return fmt::format("{}", fmt::join(std::get<std::vector<float>>(attribute), " "));
  }

  void add_run() {
    page_.heading("The run");
    if (!job_.run)
      return page_.paragraph(
          "Times and memory are known to the run that makes the image: rpf IN -o OUT --report page.html.");
    const RunFigures& run = *job_.run;
    page_.table({{"what", "value"},
                 {{"backend", run.report.backend},
                  {"seconds of filtering", fmt::format("{:.2f}", run.report.seconds)},
                  {"seconds of filtering and writing", fmt::format("{:.2f}", run.cost.wall)},
                  {"CPU seconds of the same", fmt::format("{:.2f}", run.cost.cpu)},
                  {"memory, predicted", in_megabytes(run.predicted)},
                  {"memory, the process at most", in_megabytes(run.most)},
                  {"memory, limit", in_megabytes(job_.machine.max_memory)}},
                 2});
    page_.table(passes());
  }

  /// A column a pass; methods differ in what they know of one.
  report::Table passes() const {
    const bool published = job_.run->method == Method::rpf,
               at_once = job_.run->method == Method::learned || needs_whole_frame(job_.run->method);
    report::Table table{{"means over the pixels"}, {}, 1};
    const auto add = [&](const char* name, const char* format, const auto& value) {
      std::vector<std::string> cells = {name};
      for (const PassReport& pass : job_.run->report.passes)
        cells.push_back(fmt::format(fmt::runtime(format), value(pass)));
      table.rows.push_back(cells);
    };
    for (std::size_t i = 0; i < job_.run->report.passes.size(); ++i)
      table.header.push_back(fmt::format("pass {}", i + 1));
    if (!at_once) add("box width", "{}", [](const PassReport& p) { return p.box_width; });
    if (!at_once) add("neighbors", "{:.1f}", [](const PassReport& p) { return p.neighbors; });
    if (published) add("acceptance", "{:.3f}", [](const PassReport& p) { return p.acceptance; });
    if (published) add("W", "{:.3f}", [](const PassReport& p) { return p.fraction_random; });
    if (published) add("alpha", "{:.3f}", [](const PassReport& p) { return p.alpha; });
    if (published) add("beta", "{:.3f}", [](const PassReport& p) { return p.beta; });
    add("energy", "{:.4f}", [](const PassReport& p) { return p.energy; });
    add("seconds", "{:.2f}", [](const PassReport& p) { return p.seconds; });
    return table;
  }

  void add_data() {
    page_.heading("The data");
    const SampleFileInfo& info = input_.info;
    std::vector<std::string> random, features;
    for (const SampleFileChannel& channel : info.channels) {
      if (is_random_slot(channel.slot)) random.push_back(name_in_group(channel.slot));
      if (is_feature_slot(channel.slot)) features.push_back(name_in_group(channel.slot));
    }
    page_.table({{"what", "value"},
                 {{"file", name_of_file(info.path)},
                  {"data window", text_of(info.data_window)},
                  {"samples", fmt::format("{}", info.sample_count)},
                  {"samples a pixel", info.min_samples == info.max_samples
                                          ? fmt::format("{}", info.min_samples)
                                          : fmt::format("{} to {}", info.min_samples, info.max_samples)},
                  {"pixels without samples", fmt::format("{}", info.empty_pixels)},
                  {"random parameters", listed(random)},
                  {"features", listed(features)}},
                 2});
    add_notes(job_.run ? job_.run->report.notes : noise_.notes);
  }

  void add_notes(const std::vector<InputNote>& notes) {
    if (notes.empty()) return page_.paragraph("Nothing odd was found in it.");
    report::Table table{{"note", "how often", "first at pixel"}, {}, 1};
    for (const InputNote& note : notes)
      table.rows.push_back({note.what, fmt::format("{}", note.count), fmt::format("{}, {}", note.x, note.y)});
    page_.table(table);
  }

  const FramePageJob& job_;
  FilterInput input_;
  report::HtmlPage page_;
  Image after_;
  std::optional<Image> reference_;
  report::ViewerLayer filtered_;
  std::vector<double> after_errors_;  ///< with a reference
  FrameNoise noise_;
  Window window_;  ///< of all pictures, in the input's coordinates
};

}  // namespace

std::uint64_t page_bytes(const SampleFileInfo& info, bool has_reference) {
  constexpr std::uint64_t images = 3 * 4 * sizeof(float);  // before, after, reference
  constexpr std::uint64_t layers = (3 * 3 + 3 + 6) * sizeof(float), text = 160;
  const std::uint64_t pixels = info.data_window.pixel_count();
  return pixels * images +
         std::max(pixels * (layers + text), has_reference ? pixels * text + comparing_bytes(pixels) : 0);
}

void write_frame_page(const FramePageJob& job) { FramePage(job).write(); }

}  // namespace rpf::cli
