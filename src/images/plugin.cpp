// What the library exports: io/image_library.h has the types.
#include "images/images.h"
#include "io/image_library.h"

extern "C" __attribute__((visibility("default"))) const rpf::io::ImageLibrary rpf_image_library;
extern "C" const rpf::io::ImageLibrary rpf_image_library = {rpf::images::inspect, rpf::images::read,
                                                            rpf::images::write};
