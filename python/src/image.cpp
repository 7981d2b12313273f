#include "rpf/image.h"

#include <nanobind/stl/array.h>
#include <nanobind/stl/filesystem.h>
#include <nanobind/stl/map.h>
#include <nanobind/stl/optional.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/tuple.h>
#include <nanobind/stl/variant.h>
#include <nanobind/stl/vector.h>

#include "arrays.h"
#include "bindings.h"
#include "rpf/error.h"
#include "rpf/io.h"
#include "rpf/metrics.h"

namespace rpf::python {

using namespace nb::literals;

namespace {

using Pixels = nb::ndarray<const float, nb::shape<-1, -1, -1>, nb::c_contig, nb::device::cpu>;

void init(Picture* self, const Pixels& pixels, std::vector<std::string> channels, const Origin& origin,
          const std::optional<WindowTuple>& display, const Metadata& metadata) {
  if (channels.size() != pixels.shape(2))
    throw Error(ErrorKind::input, "pixels has " + std::to_string(pixels.shape(2)) + " channels and there are " +
                                      std::to_string(channels.size()) + " names; one name for each is expected");
  auto image = std::make_shared<Image>();
  image->data_window = window_of(origin, pixels.shape(0), pixels.shape(1));
  image->display_window = display ? window_of(*display) : image->data_window;
  image->channels = std::move(channels);
  image->pixels.assign(pixels.data(), pixels.data() + pixels.size());
  image->metadata = metadata;
  new (self) Picture{std::move(image)};
}

View<float> pixels(const Picture& self) {
  const Image& image = *self.image;
  return view(image.pixels.data(),
              {static_cast<std::size_t>(image.data_window.height), static_cast<std::size_t>(image.data_window.width),
               image.channel_count()},
              self.image);
}

Picture read(const std::filesystem::path& path, std::uint64_t max_memory) {
  const nb::gil_scoped_release free_python;
  return {std::make_shared<Image>(read_image(path.string(), max_memory))};
}

void write(const std::filesystem::path& path, const Picture& picture) {
  const nb::gil_scoped_release free_python;
  write_image(path.string(), *picture.image);
}

std::string text_of(const Picture& self) {
  std::string names;
  for (const std::string& name : self.image->channels) names += (names.empty() ? "" : " ") + name;
  const Window& w = self.image->data_window;
  return "rpf.Image(" + std::to_string(w.width) + "x" + std::to_string(w.height) + " pixels, channels " + names + ")";
}

void bind_errors_of_images(nb::module_& module) {
  nb::class_<LargestDifference>(module, "LargestDifference", "Where a channel is farthest from its reference.")
      .def_ro("difference", &LargestDifference::difference, "|a - b|, linear radiance.")
      .def_ro("x", &LargestDifference::x)
      .def_ro("y", &LargestDifference::y);
  nb::class_<ImageError>(module, "ImageError", "Errors of an image against its reference (docs/commands.md).")
      .def_ro("mse", &ImageError::mse, "Mean of (a - b)^2; 0 is best.")
      .def_ro("relmse", &ImageError::relmse, "Mean of (a - b)^2 / (b^2 + 0.01); 0 is best.")
      .def_ro("trimmed_relmse", &ImageError::trimmed_relmse, "The same without the worst 0.1 % of the pixels.")
      .def_ro("mae", &ImageError::mae, "Mean of |a - b|; 0 is best.")
      .def_ro("energy", &ImageError::energy, "Sum of a / sum of b; 1 is best.")
      .def_ro("largest", &ImageError::largest, "Of R, G, B.")
      .def_ro("psnr", &ImageError::psnr, "Decibels, peak 1, of what a display shows.")
      .def_ro("ssim", &ImageError::ssim, "Mean structural similarity, at most 1; NaN below 11 pixels of a side.")
      .def_ro("flip", &ImageError::flip, "Mean of LDR-FLIP, 0 to 1; 0 is best.")
      .def_ro("hdr_flip", &ImageError::hdr_flip, "Mean of HDR-FLIP, 0 to 1; 0 is best.");
  module.def(
      "compare",
      [](const Picture& image, const Picture& reference) {
        const nb::gil_scoped_release free_python;
        return compare_images(*image.image, *reference.image);
      },
      "image"_a, "reference"_a,
      "Errors of an image against its reference, over R, G and B of all pixels. Raises InputError where sizes differ "
      "or a "
      "channel is missing.");
}

}  // namespace

void bind_image(nb::module_& module) {
  nb::class_<Picture>(
      module, "Image",
      "A linear image.\n\npixels: [height, width, channels] float32, copied once. channels: their names. origin: x, y "
      "of\n"
      "the first pixel. display_window: x, y, width, height; the data window if left out. metadata: name -> int, "
      "float,\n"
      "str or list of float. In a notebook it shows itself, with the sRGB transfer function, clamped to 0 to 1.")
      .def("__init__", &init, "pixels"_a, "channels"_a = std::vector<std::string>{"R", "G", "B"}, nb::kw_only(),
           "origin"_a = Origin(0, 0), "display_window"_a = nb::none(), "metadata"_a = Metadata{})
      .def_prop_ro("pixels", &pixels, nb::rv_policy::reference,
                   "[height, width, channels] float32, read-only, no copy; linear radiance.")
      .def_prop_ro(
          "channels", [](const Picture& p) { return p.image->channels; }, "Names of the channels: R, G, B, A ...")
      .def_prop_ro(
          "window", [](const Picture& p) { return tuple_of(p.image->data_window); },
          "x, y, width, height of the data window in pixels.")
      .def_prop_ro(
          "display_window", [](const Picture& p) { return tuple_of(p.image->display_window); },
          "x, y, width, height of the display window in pixels.")
      .def_prop_ro(
          "metadata", [](const Picture& p) { return p.image->metadata; },
          "A copy of the named values that a file keeps: int, float, str or list of float.")
      .def_ro("report", &Picture::report, "What filter() did; None for other images.")
      .def_prop_ro(
          "features",
          [](const Picture& p) -> std::optional<Picture> {
            return p.features ? std::optional(Picture{p.features}) : std::nullopt;
          },
          "The filtered features, where Settings.filter_features or estimate_error asks for them, else None.")
      .def(
          "_repr_png_",
          [](const nb::object& self) { return nb::module_::import_("rpf.picture").attr("png")(self.attr("pixels")); },
          nb::sig("def _repr_png_(self) -> bytes"))
      .def("__repr__", &text_of);
  module.def("read_image", &read, "path"_a, nb::kw_only(), "max_memory"_a = 0,
             "Reads an image of any format as linear float32. max_memory: bytes that may be taken, 0: no limit. Raises "
             "InputError, MemoryLimitError.");
  module.def("write", &write, "path"_a, "image"_a);
  bind_errors_of_images(module);
}

}  // namespace rpf::python
