// What a device can do at best, for the benchmarks to compare with (bench/roofs.cpp). Each kernel is one kind of work
// in explicit vectors, as the filter's kernels are written, without anything that waits.
#include "target.cl"

#include "frame.cl"

#define RPF_CHAINS 8  // independent, so that an operation need not wait for the one before

// A multiplication and an addition that are two roundings, as the contract wants; `fused` with one.
__kernel void roof_multiply_add(__global float16* out, const uint rounds, const float a, const float b,
                                const int fused) {
  float16 x[RPF_CHAINS];
  for (int c = 0; c < RPF_CHAINS; ++c) x[c] = (float)c;
  if (fused)
    for (uint i = 0; i < rounds; ++i)
#pragma unroll
      for (int c = 0; c < RPF_CHAINS; ++c) x[c] = fma(x[c], (float16)(a), (float16)(b));
  else
    for (uint i = 0; i < rounds; ++i)
#pragma unroll
      for (int c = 0; c < RPF_CHAINS; ++c) x[c] = x[c] * a + b;
  float16 sum = 0.0f;
  for (int c = 0; c < RPF_CHAINS; ++c) sum += x[c];
  out[get_global_id(0)] = sum;
}

// RPF_CHAINS * RPF_LANES exponentials a round.
__kernel void roof_exp(__global float16* out, const uint rounds, const float step) {
  float16 sum[RPF_CHAINS];
  for (int c = 0; c < RPF_CHAINS; ++c) sum[c] = 0.0f;
  for (uint i = 0; i < rounds; ++i)
#pragma unroll
    for (int c = 0; c < RPF_CHAINS; ++c)
      sum[c] += rpf_exp(-step * (float)((i + 8 * c) & 63u) - convert_float16(RPF_LANE_NUMBERS));
  float16 total = 0.0f;
  for (int c = 0; c < RPF_CHAINS; ++c) total += sum[c];
  out[get_global_id(0)] = total;
}

#ifdef RPF_AVX512
#pragma clang attribute push(RPF_TARGET, apply_to = function)
#endif
#include "bit_counts.cl"

// The bits that a plane of `vectors` has in common with each of two others, as histograms are counted.
__attribute__((noinline)) static ulong common_bits(__global const ulong8* a, __global const ulong8* b0,
                                                   __global const ulong8* b1, size_t vectors) {
  ulong8 count = 0;
  for (size_t first = 0, end; first < vectors; first = end) {
    end = end_of_words(first, vectors);
    ulong8 sum0 = 0, sum1 = 0;
    for (size_t w = first; w < end; ++w) {
      sum0 += bits_of(a[w] & b0[w]);
      sum1 += bits_of(a[w] & b1[w]);
    }
    count += total_of(sum0) + total_of(sum1);
  }
  return count.s0 + count.s1 + count.s2 + count.s3 + count.s4 + count.s5 + count.s6 + count.s7;
}
#ifdef RPF_AVX512
#pragma clang attribute pop
#endif

// Of planes of `words` 64-bit words, a multiple of 8.
__kernel void roof_popcount(__global ulong* out, __global const ulong8* planes, const uint words, const uint rounds) {
  const uint vectors = words / 8;
  ulong count = 0;
  for (uint i = 0; i < rounds; ++i)
    count += common_bits(planes + (i & 7u) * vectors, planes + (i >> 3 & 3u) * vectors,
                         planes + (4 + (i >> 5 & 3u)) * vectors, vectors);
  out[get_global_id(0)] = count;
}

// Reads `blocks` vectors in order, `rounds` times.
__kernel void roof_read(__global float16* out, __global const float16* values, const uint blocks, const uint rounds) {
  float16 sum[RPF_CHAINS];
  for (int c = 0; c < RPF_CHAINS; ++c) sum[c] = 0.0f;
  for (uint round = 0; round < rounds; ++round)
    for (uint i = 0; i + RPF_CHAINS <= blocks; i += RPF_CHAINS)
#pragma unroll
      for (int c = 0; c < RPF_CHAINS; ++c) sum[c] += values[i + c];
  float16 total = 0.0f;
  for (int c = 0; c < RPF_CHAINS; ++c) total += sum[c];
  out[get_global_id(0)] = total;
}

// Reads vectors in the order of `places`: records that were drawn.
__kernel void roof_random_read(__global float16* out, __global const float16* values, __global const uint* places,
                               const uint count) {
  float16 sum[RPF_CHAINS];
  for (int c = 0; c < RPF_CHAINS; ++c) sum[c] = 0.0f;
  for (uint i = 0; i + RPF_CHAINS <= count; i += RPF_CHAINS)
#pragma unroll
    for (int c = 0; c < RPF_CHAINS; ++c) sum[c] += values[places[i + c]];
  float16 total = 0.0f;
  for (int c = 0; c < RPF_CHAINS; ++c) total += sum[c];
  out[get_global_id(0)] = total;
}
