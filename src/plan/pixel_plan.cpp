#include "plan/pixel_plan.h"

#include "plan/axis_aligned.h"
#include "plan/gaussian_bank.h"
#include "plan/non_local_means.h"
#include "plan/stein_risk.h"
#include "rpf/error.h"

namespace rpf {

PixelPlan make_pixel_plan(const FrameFacts& facts, const Settings& settings) {
  validate(settings);
  if (settings.method != Method::axis_aligned && facts.max_samples_per_pixel < 2)
    throw Error(ErrorKind::input,
                "no pixel has two samples, which are needed to tell noise; render with 2 samples a pixel or more, or "
                "choose another --method");
  PixelPlan plan;
  PixelPlanning planning(facts, plan);
  if (settings.method == Method::nlm) plan_non_local_means(settings, planning, plan);
  if (settings.method == Method::gem) plan_gaussian_bank(settings, planning, plan);
  if (settings.method == Method::sbf) plan_stein_risk(planning, plan);
  if (settings.method == Method::axis_aligned) plan_axis_aligned(settings, planning, plan);
  return plan;
}

}  // namespace rpf
