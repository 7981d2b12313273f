#include "c_api/objects.h"
#include "rpf/io.h"

using rpf::c_api::guarded;
using rpf::c_api::require;

rpf_status rpf_image_read(const char* path, rpf_image** image) {
  return guarded([&] {
    require(image, "rpf_image_read: image");
    *image = nullptr;
    require(path, "rpf_image_read: path");
    *image = new rpf_image{rpf::read_image(path)};
  });
}

rpf_status rpf_image_write(const char* path, const rpf_image* image) {
  return guarded([&] {
    require(path, "rpf_image_write: path");
    require(image, "rpf_image_write: image");
    rpf::write_image(path, image->value);
  });
}

int rpf_image_width(const rpf_image* image) { return image->value.data_window.width; }

int rpf_image_height(const rpf_image* image) { return image->value.data_window.height; }

int rpf_image_channel_count(const rpf_image* image) { return static_cast<int>(image->value.channel_count()); }

const char* rpf_image_channel_name(const rpf_image* image, int channel) {
  const bool is_there = channel >= 0 && channel < rpf_image_channel_count(image);
  return is_there ? image->value.channels[static_cast<std::size_t>(channel)].c_str() : "";
}

const float* rpf_image_pixels(const rpf_image* image) { return image->value.pixels.data(); }

void rpf_image_free(rpf_image* image) { delete image; }
