// image_to_floats IMAGE OUT: R, G, B of all pixels as 32-bit floats, row by row; prints width and height.
#include <algorithm>
#include <fstream>
#include <iostream>

#include "rpf/io.h"

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const rpf::Image image = rpf::read_image(argv[1]);
  std::ofstream out(argv[2], std::ios::binary);
  for (std::size_t p = 0; p < image.data_window.pixel_count(); ++p)
    for (const char* name : {"R", "G", "B"}) {
      const auto column = std::find(image.channels.begin(), image.channels.end(), name) - image.channels.begin();
      out.write(reinterpret_cast<const char*>(image.pixel(p) + column), sizeof(float));
    }
  std::cout << image.data_window.width << ' ' << image.data_window.height << '\n';
  return out.flush() ? 0 : 1;
}
