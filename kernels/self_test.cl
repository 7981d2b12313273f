// What the numeric contract promises, computed on the device for the host to compare (src/opencl/self_test.cpp).
#include "rpf_math.h"

// One result after the other for every triple of inputs; the vector forms use the same lane of a float16.
#define RPF_SELF_TEST_RESULTS 8

static float lane_of(float16 value, uint lane) {
  float lanes[RPF_LANES];
  vstore16(value, 0, lanes);
  return lanes[lane];
}

__kernel void self_test(__global const float* a, __global const float* b, __global const float* c,
                        __global float* results) {
  const uint i = (uint)get_global_id(0), lane = i % RPF_LANES;
  const float16 vector_a = vload16(i / RPF_LANES, a), vector_b = vload16(i / RPF_LANES, b);
  __global float* result = results + i * RPF_SELF_TEST_RESULTS;
  result[0] = a[i] * b[i] + c[i];
  result[1] = a[i] / b[i];
  result[2] = sqrt(fabs(a[i]));
  result[3] = rpf_exp(-fabs(c[i]));
  result[4] = lane_of(rpf_exp(-fabs(vload16(i / RPF_LANES, c))), lane);
  result[5] = lane_of(vector_a * vector_b + vload16(i / RPF_LANES, c), lane);
  result[6] = lane_of(sqrt(fabs(vector_a)) / vector_b, lane);
  result[7] = (float)(rpf_hash(as_uint(a[i]), as_uint(b[i]), i).x >> 8);
}

// A sum in order. It has no loop around it: that is where Intel's compiler takes additions in another one.
__kernel void self_test_sum(__global const float* values, __global float* result, const uint count) {
  float sum = 0.0f;
  for (uint k = 0; k < count; ++k) sum = rpf_added(sum, values[k]);
  result[get_global_id(0)] = sum;
}
