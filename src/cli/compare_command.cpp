#include <fmt/format.h>

#include "cli/commands.h"
#include "cli/picture.h"
#include "rpf/error.h"
#include "rpf/io.h"
#include "rpf/metrics.h"

namespace rpf::cli {
namespace {

struct Options {
  std::vector<std::string> files;
  std::string side_by_side;
};

int run(const Options& options) {
  if (options.files.size() < 2)
    throw Error(ErrorKind::usage, "compare: one or more images and, last, their reference are expected");
  std::vector<Image> images;
  for (const std::string& file : options.files) images.push_back(read_image(file));
  fmt::print("{:>12} {:>12} {:>9}  {}\n", "relMSE", "MSE", "energy", "image");
  for (std::size_t i = 0; i + 1 < images.size(); ++i) {
    const ImageError error = compare_images(images[i], images.back());
    fmt::print("{:>12.6f} {:>12.6g} {:>9.4f}  {}\n", error.relmse, error.mse, error.energy, options.files[i]);
  }
  if (!options.side_by_side.empty()) write_image(options.side_by_side, side_by_side(images));
  return 0;
}

}  // namespace

Command add_compare_command(CLI::App& app) {
  auto options = std::make_shared<Options>();
  CLI::App* command =
      app.add_subcommand("compare", "Measure images against a reference: relMSE (epsilon 0.01), MSE, energy ratio");
  command->add_option("IMAGES", options->files, "Images, the reference last")->required();
  command->add_option("--side-by-side", options->side_by_side, "Also write all of them in a row")
      ->type_name("FILE.png");
  return [options] { return run(*options); };
}

}  // namespace rpf::cli
