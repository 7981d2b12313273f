#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <limits>

#include "cli/commands.h"
#include "cli/compare_report.h"
#include "cli/environment.h"
#include "cli/filter_options.h"
#include "cli/measuring.h"
#include "cli/needs.h"
#include "cli/numbers.h"
#include "cli/print.h"
#include "report/heat_map.h"
#include "report/picture.h"
#include "rpf/error.h"
#include "rpf/io.h"
#include "rpf/metrics.h"
#include "rpf/outputs.h"

namespace rpf::cli {
namespace {

constexpr int exit_above_limit = 1;

struct Options {
  std::vector<std::string> files;
  std::string side_by_side;
  std::string zoom;  ///< of side_by_side; empty: where the first image's error is largest
  std::string diff;
  bool json = false;
  std::uint64_t max_memory_mb = 0;  ///< 0: not given
  double max_error = std::numeric_limits<double>::infinity();
  bool limited = false;  ///< max_error was given
};

ImageError error_of(const Options& options, std::size_t number, const std::vector<Image>& images) {
  return measuring(options.files[number], options.files.back(),
                   [&] { return compare_images(images[number], images.back()); });
}

Comparison compare(const Options& options, const std::vector<Image>& images) {
  Comparison comparison{{}, options.files.back(), options.diff};
  for (std::size_t i = 0; i + 1 < images.size(); ++i)
    comparison.images.push_back({options.files[i], error_of(options, i, images)});
  return comparison;
}

Image heat_maps(const std::vector<Image>& images) {
  std::vector<Image> maps;
  for (std::size_t i = 0; i + 1 < images.size(); ++i)
    maps.push_back(report::heat_map(relative_error_map(images[i], images.back())));
  return report::with_legend(report::side_by_side(maps));
}

/// Counts from the first pixel, while the option counts in the reference's coordinates.
std::optional<Window> crop_of(const std::string& zoom, const std::vector<Image>& images) {
  const Window& frame = images.back().data_window;
  if (zoom == "none") return std::nullopt;
  if (zoom.empty()) return report::worst_crop(relative_error_map(images.front(), images.back()));
  Window crop = window_of("--zoom", zoom);
  const auto inside = [](std::int64_t offset, int length, int limit) {
    return offset >= 0 && offset + length <= limit;
  };
  const std::int64_t x = std::int64_t{crop.x} - frame.x, y = std::int64_t{crop.y} - frame.y;
  if (!inside(x, crop.width, frame.width) || !inside(y, crop.height, frame.height))
    throw Error(ErrorKind::usage,
                fmt::format("--zoom {}: not inside the reference's data window {}", zoom, text_of(frame)));
  return Window{static_cast<int>(x), static_cast<int>(y), crop.width, crop.height};
}

/// Says which images are above the limit. An error that is no number is above every limit.
bool above_limit(const Comparison& comparison, double limit) {
  bool above = false;
  for (const ComparedImage& image : comparison.images) {
    if (image.error.relmse <= limit) continue;
    remark("rpf: \"{}\": relMSE {:.6g} is above --max-error {:.6g}\n", image.file, image.error.relmse, limit);
    above = true;
  }
  return above;
}

/// Needs more than the limit: refused before anything is read.
void check_memory(const Options& options, std::uint64_t limit) {
  constexpr std::uint64_t picture = 3 * sizeof(float);
  std::uint64_t images = 0, pixels = 0;
  for (const std::string& file : options.files) {
    const Image header = inspect_image(file);
    images += image_bytes(header);
    pixels = std::max<std::uint64_t>(pixels, header.data_window.pixel_count());
  }
  // Side by side all of them are there twice, and as big as the picture once more.
  const bool writes = !options.side_by_side.empty() || !options.diff.empty();
  const std::uint64_t pictures = writes ? 3 * options.files.size() * pixels * picture : 0;
  check_images_need("compare", options.files.size(), images + std::max(comparing_bytes(pixels), pictures), limit);
}

std::vector<PlannedOutput> planned_outputs(const Options& options) {
  std::vector<PlannedOutput> outputs;
  for (const std::string& picture : {options.side_by_side, options.diff})
    if (!picture.empty()) outputs.push_back({picture});
  return outputs;
}

int run(const Options& options) {
  if (options.files.size() < 2)
    throw Error(ErrorKind::usage, "compare: one or more images and, last, their reference are expected");
  check_outputs(planned_outputs(options), options.files);
  const std::uint64_t limit = memory_limit(options.max_memory_mb);
  check_memory(options, limit);
  std::vector<Image> images;
  for (const std::string& file : options.files) images.push_back(read_image(file, limit));
  const Comparison comparison = compare(options, images);
  for (std::size_t i = 0; i + 1 < images.size(); ++i)
    tell_display_window(options.files[i], images[i].display_window, "its reference", images.back().display_window);
  if (!options.side_by_side.empty())
    write_image(options.side_by_side, report::side_by_side(images, crop_of(options.zoom, images)));
  if (!options.diff.empty()) write_image(options.diff, heat_maps(images));
  print("{}", options.json ? json_of(comparison) : table_of(comparison));
  return options.limited && above_limit(comparison, options.max_error) ? exit_above_limit : 0;
}

}  // namespace

Command add_compare_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command = app.add_subcommand(
      "compare",
      "Measure images against a reference: relMSE, MSE, energy, trimmed relMSE, MAE, PSNR, SSIM, FLIP, HDR-FLIP");
  command->add_option("IMAGES", options->files, "Images, the reference last")->required();
  CLI::Option* side_by_side = command
                                  ->add_option("--side-by-side", options->side_by_side,
                                               "Also write all of them in a row, and a zoomed crop of each below")
                                  ->type_name("FILE.png");
  command
      ->add_option("--zoom", options->zoom,
                   "The crop of --side-by-side in the reference's coordinates, or none; if not given, where the first "
                   "image's error is largest")
      ->type_name("WxH+X+Y")
      ->needs(side_by_side);
  command->add_option("--diff", options->diff, "Also write heat maps of the relative squared error, with a legend")
      ->type_name("FILE.png");
  add_memory_option(*command, options->max_memory_mb);
  command->add_flag("--json", options->json, "Print JSON in place of the tables");
  CLI::Option* limit = restrict_to(
      command->add_option("--max-error", options->max_error, "Exit code 1 where an image's relMSE is above this"),
      ranges::error);
  return [options, limit] {
    options->limited = limit->count() > 0;
    return run(*options);
  };
}

}  // namespace rpf::cli
