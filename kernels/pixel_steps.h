// All steps of the methods that filter pixels.
#ifndef RPF_PIXEL_STEPS_H
#define RPF_PIXEL_STEPS_H
// NOLINTBEGIN(modernize-*, cppcoreguidelines-*): this is OpenCL C too

#include "bank_steps.h"
#include "patch_steps.h"
#include "risk_steps.h"
#include "shadow_steps.h"

#ifdef __cplusplus
namespace rpf::kernel {
#endif

RPF_INLINE void rpf_run_step(RPF_PLANES float* planes, const rpf_pixel_step* step, rpf_pixel_run run) {
  switch (step->kind) {
    case RPF_STEP_PATCH_DISTANCE:
      return rpf_patch_distance(planes, step, run);
    case RPF_STEP_BOX_ROWS:
      return rpf_box_rows(planes, step, run);
    case RPF_STEP_PATCH_WEIGHT:
      return rpf_patch_weight(planes, step, run);
    case RPF_STEP_PATCH_SHARE:
      return rpf_patch_share(planes, step, run);
    case RPF_STEP_GATHER:
      return rpf_gather(planes, step, run);
    case RPF_STEP_AVERAGE:
      return rpf_average(planes, step, run);
    case RPF_STEP_MIX:
      return rpf_mix(planes, step, run);
    case RPF_STEP_KERNEL_ROWS:
      return rpf_kernel_rows(planes, step, run);
    case RPF_STEP_KERNEL_COLUMNS:
      return rpf_kernel_columns(planes, step, run);
    case RPF_STEP_NORMALIZE:
      return rpf_normalize_planes(planes, step, run);
    case RPF_STEP_STOP:
      return rpf_stop(planes, step, run);
    case RPF_STEP_CHOOSE_SCALE:
      return rpf_choose_scale(planes, step, run);
    case RPF_STEP_FEATURE_WEIGHT:
      return rpf_feature_weight(planes, step, run);
    case RPF_STEP_RISK:
      return rpf_risk(planes, step, run);
    case RPF_STEP_CHOOSE_LEAST:
      return rpf_choose_least(planes, step, run);
    case RPF_STEP_SHADOW_FALLOFF:
      return rpf_shadow_falloff(planes, step, run);
    case RPF_STEP_SURFACE_WEIGHT:
      return rpf_surface_weight(planes, step, run);
    case RPF_STEP_WITHOUT_ALBEDO:
      return rpf_without_albedo(planes, step, run);
    case RPF_STEP_WITH_ALBEDO:
      return rpf_with_albedo(planes, step, run);
  }
}

#ifdef __cplusplus
}  // namespace rpf::kernel
#endif

// NOLINTEND(modernize-*, cppcoreguidelines-*)
#endif
