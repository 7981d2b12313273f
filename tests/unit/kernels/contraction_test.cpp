// Compiled with -mfma on top of the project's flags: a compiler that contracts a * b + c would do so here.
#include <gtest/gtest.h>

#include "rpf_math.h"

namespace rpf::kernel {
namespace {

/// Hides values from the optimizer.
float opaque(float value) {
  volatile float hidden = value;
  return hidden;
}

TEST(Contraction, IsOffWhereTheKernelsAreCompiled) {
  if (!__builtin_cpu_supports("fma")) GTEST_SKIP() << "this processor has no fused multiply-add";
  // (1 + 2^-12)^2 = 1 + 2^-11 + 2^-24: two roundings lose the last term, a fused operation keeps it.
  const float a = opaque(1.0F + 0x1p-12F), c = opaque(-(1.0F + 0x1p-11F));
  EXPECT_EQ(a * a + c, 0.0F);
}

}  // namespace
}  // namespace rpf::kernel
