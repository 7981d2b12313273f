// The steps of the methods that filter pixels and not samples (algorithm.md, section 9). A picture is a stack of
// planes, [plane][row][pixel]; a step makes some planes from others, and every pixel of it for itself. So one text
// serves both backends: a method is a list of steps (src/plan), a backend is what runs them row by row.
#ifndef RPF_PIXEL_STEP_H
#define RPF_PIXEL_STEP_H
// NOLINTBEGIN(modernize-*, cppcoreguidelines-*): this is OpenCL C too

#include "numeric.h"

#ifdef __cplusplus
namespace rpf::kernel {
#define RPF_PLANES
#else
#define RPF_PLANES __global
#endif

// What a step is: RPF_STEP_ and a name; the function of that name says what it reads and makes.
#define RPF_STEP_PATCH_DISTANCE 1
#define RPF_STEP_BOX_ROWS 2
#define RPF_STEP_PATCH_WEIGHT 3
#define RPF_STEP_PATCH_SHARE 4
#define RPF_STEP_GATHER 5
#define RPF_STEP_AVERAGE 6
#define RPF_STEP_MIX 7
#define RPF_STEP_KERNEL_ROWS 8
#define RPF_STEP_KERNEL_COLUMNS 9
#define RPF_STEP_NORMALIZE 10
#define RPF_STEP_STOP 11
#define RPF_STEP_CHOOSE_SCALE 12
#define RPF_STEP_FEATURE_WEIGHT 13
#define RPF_STEP_RISK 14
#define RPF_STEP_CHOOSE_LEAST 15
#define RPF_STEP_SHADOW_FALLOFF 16
#define RPF_STEP_SURFACE_WEIGHT 17
#define RPF_STEP_WITHOUT_ALBEDO 18
#define RPF_STEP_WITH_ALBEDO 19

#define RPF_STEP_WEIGHTS 64  // numbers that a step brings along

typedef struct {
  int kind;
  int width, height;   // of all planes, pixels
  uint in, by, out;    // the first plane of each group
  uint mask;           // a plane that is 1 where a pixel has samples, 0 where not
  uint count;          // planes of a group that are treated alike
  int dx, dy;          // of a neighbor q = p + (dx, dy)
  int reach;           // pixels to each side
  float scale, least;  // constants of the formula
  float weights[RPF_STEP_WEIGHTS];
} rpf_pixel_step;

#ifdef __cplusplus
}  // namespace rpf::kernel
#endif

// NOLINTEND(modernize-*, cppcoreguidelines-*)
#endif
