// A step of a method that filters pixels, on a device.
#include "pixel_steps.h"

#define RPF_RUN_PIXELS 256  // a work-item's part of a row: long for vectors, short for many work-items

__kernel void pixel_step(__global float* planes, const rpf_pixel_step step) {
  const int parts = (step.width + RPF_RUN_PIXELS - 1) / RPF_RUN_PIXELS;
  for (int i = (int)get_global_id(0); i < parts * step.height; i += (int)get_global_size(0)) {
    rpf_pixel_run run;
    run.y = i / parts;
    run.x0 = (i - run.y * parts) * RPF_RUN_PIXELS;
    run.x1 = run.x0 + RPF_RUN_PIXELS < step.width ? run.x0 + RPF_RUN_PIXELS : step.width;
    rpf_run_step(planes, &step, run);
  }
}
