// Filters a sample file: filter_file INPUT.exr OUTPUT.exr
#include <iostream>

#include "rpf/rpf.h"

int main(int argc, char** argv) try {
  if (argc != 3) return 2;
  rpf::Settings settings;
  settings.profile = rpf::Profile::paper;
  const rpf::Result result = rpf::filter(rpf::read_samples(argv[1]), settings);
  rpf::write_image(argv[2], result.image);
  return 0;
} catch (const rpf::Error& e) {
  std::cerr << e.what() << '\n';
  return static_cast<int>(e.kind());
}
