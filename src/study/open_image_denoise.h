// Open Image Denoise beside the filters, where it is installed: loaded when it is first asked for.
#pragma once

#include "rpf/filter.h"

namespace rpf::study {

/// Whether the library can be loaded: libOpenImageDenoise.so.2 or .so.1, where the system looks for libraries.
bool has_open_image_denoise();

/// The denoised plain mean of the samples, with the means of normals and albedo as they are, on the processor; of the
/// report the energy alone. Throws as filter() does, and Error(device) where the library fails or is missing.
Result open_image_denoise(SampleBuffer samples);

}  // namespace rpf::study
