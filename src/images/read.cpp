// Images in, through OpenImageIO, as linear float.
#include "images/images.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <stdexcept>
#include <string_view>

#include "io/attributes.h"
#include "io/file_bytes.h"
#include "io/guard.h"
#include "io/raw_header.h"
#include "rpf/srgb.h"

namespace rpf::images {
namespace {

namespace oiio = OIIO;
using namespace rpf::io;

[[noreturn]] void reject(const std::string& path, const std::string& what) {
  throw Error(ErrorKind::input, fmt::format("\"{}\" {}", path, what));
}

std::string part_name(const oiio::ImageSpec& spec) {
  const std::string name = spec.get_string_attribute("oiio:subimagename");
  return name.empty() ? std::string(spec.get_string_attribute("name")) : name;
}

// Parts of an EXR file, pages of a TIFF, frames of a GIF: all but one would be lost. On an input of its own: not every
// format finds the way back to its first image.
void check_parts(const std::string& path) {
  const auto input = oiio::ImageInput::open(path);
  if (!input) return;  // the caller's own opening says why
  if (input->spec().depth > 1) reject(path, "is a volume, but an image is needed; write a slice of it as a file");
  const std::string first = part_name(input->spec());
  if (!input->seek_subimage(1, 0)) {
    (void)input->geterror();  // there is no second one, which is well
    return;
  }
  const int count = input->spec().get_int_attribute("oiio:subimages");
  const std::string second = part_name(input->spec());
  const std::string names = first.empty() || second.empty() ? "" : fmt::format(" (\"{}\", \"{}\", ...)", first, second);
  reject(path,
         fmt::format("holds {} images{}, but one is needed, or the others would be lost; write each as a file, with "
                     "exrmultipart -separate or oiiotool",
                     count > 1 ? std::to_string(count) : "several", names));
}

// OpenEXR's integers are numbers of objects and samples; OpenImageIO would divide them by 2^32 as if they were colors.
void check_types(const std::string& path, const oiio::ImageInput& input) {
  if (std::string_view(input.format_name()) != "openexr") return;
  const oiio::ImageSpec& spec = input.spec();
  for (int c = 0; c < spec.nchannels; ++c) {
    const std::string& name = spec.channelnames[c];
    const bool is_used = c == 0 || name == "R" || name == "G" || name == "B" || name == "A";
    if (is_used && spec.channelformat(c) == oiio::TypeUInt32)
      reject(path, fmt::format("has integers in its channel {}; write float or half", name));
  }
}

std::unique_ptr<oiio::ImageInput> open_image(const std::string& path) {
  FileBytes file(path);  // for its clear errors: missing, folder, no permission
  if (begins_like_raw(file))
    reject(path, "begins like a raw sample file, but an image is needed; filter the samples first");
  oiio::ImageSpec config;
  // OpenImageIO would multiply the encoded colors by alpha; we do it after decoding.
  config.attribute("oiio:UnassociatedAlpha", 1);
  auto input = oiio::ImageInput::open(path, &config);
  if (!input)
    reject(path, fmt::format("cannot be read as an image ({}); use .exr, .tif, .hdr, .png or another image format",
                             first_line(oiio::geterror())));
  check_parts(path);
  if (input->spec().deep) reject(path, "is a deep file, but a flat image is needed; filter the samples first");
  check_types(path, *input);
  return input;
}

// How stored values become linear light: the exponent of a power curve, 0 for sRGB, 1 for linear values.
double gamma_of(const oiio::ImageSpec& spec) {
  // 16-bit integers are encoded like 8-bit ones; float formats hold linear light whatever they say.
  const std::string space = spec.get_string_attribute("oiio:ColorSpace");
  const bool integer = !spec.format.is_floating_point();
  if (space == "Linear" || !integer) return 1;
  if (space.compare(0, 5, "Gamma") == 0) {
    double gamma = 0;
    std::from_chars(space.data() + 5, space.data() + space.size(), gamma);  // strtod would ask the locale
    return gamma > 0 ? gamma : 1;
  }
  return 0;
}

bool is_color(const oiio::ImageSpec& spec, int channel) {
  return channel != spec.alpha_channel && channel != spec.z_channel;
}

void to_linear(const oiio::ImageSpec& spec, Image& image) {
  const double gamma = gamma_of(spec);
  if (gamma == 1) return;
  for (std::size_t pixel = 0; pixel < image.data_window.pixel_count(); ++pixel)
    for (int c = 0; c < spec.nchannels; ++c) {
      float& value = image.pixel(pixel)[c];
      if (is_color(spec, c)) value = static_cast<float>(gamma == 0 ? srgb_decode(value) : std::pow(value, gamma));
    }
}

// Our images have colors multiplied by alpha, as renderers write them.
void multiply_by_alpha(const oiio::ImageSpec& spec, Image& image) {
  if (spec.alpha_channel < 0 || spec.get_int_attribute("oiio:UnassociatedAlpha") == 0) return;
  for (std::size_t pixel = 0; pixel < image.data_window.pixel_count(); ++pixel)
    for (int c = 0; c < spec.nchannels; ++c)
      if (is_color(spec, c)) image.pixel(pixel)[c] *= image.pixel(pixel)[spec.alpha_channel];
}

// Attributes that describe the file ("tiff:RowsPerStrip") are left out.
void take_attribute(const oiio::ParamValue& attribute, const std::string& format, Image& image) {
  Metadata& metadata = image.metadata;
  const std::string name = exr_name(attribute.name().string());
  const oiio::TypeDesc type = attribute.type();
  const auto count = type.numelements() * type.aggregate;
  for (const std::string& prefix : {std::string("oiio:"), format + ":"})
    if (name.compare(0, prefix.size(), prefix) == 0) return;
  if (is_structural(name)) return;
  if (type == oiio::TypeString) metadata[name] = attribute.get_string();
  if (type == oiio::TypeInt) metadata[name] = static_cast<std::int32_t>(attribute.get_int());
  if (type != oiio::TypeString && type != oiio::TypeInt && type.basetype != oiio::TypeDesc::FLOAT)
    image.dropped.push_back(printable(fmt::format("{} ({})", name, type.c_str())));
  if (type.basetype != oiio::TypeDesc::FLOAT) return;
  const auto* first = static_cast<const float*>(attribute.data());
  if (count == 1)
    metadata[name] = *first;
  else
    metadata[name] = std::vector<float>(first, first + count);
}

// The eye that R, G and B are of: the first is the default one, whose channels stand without its name.
std::string view_of(const oiio::ImageSpec& spec) {
  const oiio::ParamValue* views = spec.find_attribute("multiView");
  if (views == nullptr) return spec.get_string_attribute("view");
  return views->type().basetype == oiio::TypeDesc::STRING ? views->get_string_indexed(0) : "";
}

Image describe(const oiio::ImageSpec& spec, const std::string& format) {
  Image image;
  image.data_window = {spec.x, spec.y, spec.width, spec.height};
  image.display_window = {spec.full_x, spec.full_y, spec.full_width, spec.full_height};
  image.channels = spec.channelnames;
  for (const oiio::ParamValue& attribute : spec.extra_attribs) take_attribute(attribute, format, image);
  for (int c = 0; c < spec.nchannels; ++c)
    if (spec.channelformat(c) == oiio::TypeHalf) image.half_channels.push_back(spec.channelnames[c]);
  image.view = view_of(spec);
  image.value_bits = static_cast<int>(spec.format.basesize()) * 8;
  return image;
}

// Some rows at a time: a header may promise more pixels than there are, and memory is taken for those that come.
void read_pixels(oiio::ImageInput& input, Image& image) {
  constexpr std::size_t values_at_once = 4 << 20;
  const oiio::ImageSpec spec = input.spec();
  const std::size_t row = static_cast<std::size_t>(spec.width) * image.channel_count();
  const bool tiled = spec.tile_width > 0;
  const int rows = tiled ? spec.height : static_cast<int>(std::max<std::size_t>(values_at_once / row, 1));
  image.pixels.reserve(row * static_cast<std::size_t>(spec.height));
  bool done = true;
  for (int y = 0; done && y < spec.height; y += rows) {
    const int end = std::min(y + rows, spec.height);
    image.pixels.resize(row * static_cast<std::size_t>(end));
    float* to = image.pixels.data() + row * static_cast<std::size_t>(y);
    done = tiled ? input.read_image(0, 0, 0, spec.nchannels, oiio::TypeFloat, to)
                 : input.read_scanlines(0, 0, spec.y + y, spec.y + end, 0, 0, spec.nchannels, oiio::TypeFloat, to);
  }
  // A truncated TIFF is "read" with success and an error waiting.
  if (!done || input.has_error()) throw std::runtime_error(input.geterror());
}

}  // namespace

Image inspect(const std::string& path) {
  return guard_input(path, [&] {
    const auto input = open_image(path);
    return describe(input->spec(), input->format_name());
  });
}

Image read(const std::string& path) {
  return guard_input(path, [&] {
    const auto input = open_image(path);
    const oiio::ImageSpec& spec = input->spec();
    Image image = describe(spec, input->format_name());
    read_pixels(*input, image);
    to_linear(spec, image);
    multiply_by_alpha(spec, image);
    return image;
  });
}

}  // namespace rpf::images
