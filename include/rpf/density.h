// How many samples each pixel should get in a renderer's next round (docs/explain.md).
#pragma once

#include "rpf/image.h"
#include "rpf/samples.h"

namespace rpf {

/// One channel, "Y", over the data window: whole numbers, 1 or more, whose mean is `samples` exactly; `rpf scene
/// --spp 1 --density` renders as many. They bring the pixels' totals, those of `frame` among them, to what makes the
/// relMSE of the plain mean least; pixels that no further sample should go to get one. Values that are not finite do
/// not count. Throws Error(usage) for less than 1 sample, Error(input) where no pixel has two samples.
Image sample_density(const SampleBuffer& frame, int samples);

/// The same for what a method leaves after filtering, too. `estimate`: features of filter() with
/// Settings::estimate_error, of which the channel "error" counts. Totals follow the geometric mean of what that and the
/// noise ask for. Throws Error(input) where the channel is missing or the data windows differ.
Image sample_density(const SampleBuffer& frame, int samples, const Image& estimate);

/// How many samples the functions of this header leave out, as their R, G or B is not finite.
std::size_t count_not_finite(const SampleBuffer& frame);

/// The relMSE that the plain mean of the samples has, estimated from their variance around each pixel: without what all
/// of them miss, such as a light that none has found. Pixels without samples are left out. Throws Error(input) where no
/// pixel has two samples.
double mean_error(const SampleBuffer& frame);

}  // namespace rpf
