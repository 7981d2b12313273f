// rpf_exp at every float of its domain (docs/stability.md, "The exponential").
#include "opencl/opencl.h"  // first: it configures the OpenCL header

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <thread>

#include "numeric.h"
#include "opencl/kernel_source.h"
#include "opencl/session.h"
#include "test_frames.h"
#include "tolerances.h"

namespace rpf {
namespace {

// Bit patterns of negative floats grow with their magnitude.
constexpr std::uint32_t minus_zero = 0x80000000U, minus_87 = 0xC2AE0000U, minus_infinity = 0xFF800000U;

float float_of(std::uint32_t bits) { return kernel::as_float(static_cast<int>(bits)); }

/// How many floats have an error of how many twentieths of a unit in the last place.
struct Histogram {
  std::array<std::uint64_t, 41> count = {};
  double largest = 0;

  void add(float value, double truth) {
    const int exponent = std::max(std::ilogb(truth), -126);
    const double ulps = std::fabs(value - truth) * std::ldexp(1.0, 23 - exponent);
    largest = std::max(largest, ulps);
    ++count[std::min<std::size_t>(static_cast<std::size_t>(ulps * 20), count.size() - 1)];
  }
};

/// Every `step`-th float from `first` to -87. exp() of double is within one unit of 2^-53: 2e-9 of ours.
Histogram measure(std::uint32_t first, std::uint32_t step) {
  Histogram histogram;
  for (std::uint32_t bits = first; bits <= minus_87; bits += step) {
    const float x = float_of(bits);
    histogram.add(kernel::rpf_exp(x), std::exp(static_cast<double>(x)));
  }
  return histogram;
}

TEST(ExpOfEveryFloat, IsWithinOneUnitInTheLastPlace) {
  if (test::backend_under_test() != "cpu") GTEST_SKIP() << "the device is compared with the reference bit by bit";
  const std::uint32_t threads = std::max(1U, std::thread::hardware_concurrency());
  std::vector<Histogram> parts(threads);
  std::vector<std::thread> crew;
  for (std::uint32_t t = 0; t < threads; ++t)
    crew.emplace_back([&parts, t, threads] { parts[t] = measure(minus_zero + t, threads); });
  for (std::thread& one : crew) one.join();
  std::uint64_t total = 0;
  double largest = 0;
  for (std::size_t i = 0; i < parts[0].count.size(); ++i) {
    std::uint64_t count = 0;
    for (const Histogram& part : parts) count += part.count[i];
    total += count;
    if (count > 0) std::printf("ulp %.2f %llu\n", static_cast<double>(i) / 20, static_cast<unsigned long long>(count));
  }
  for (const Histogram& part : parts) largest = std::max(largest, part.largest);
  std::printf("largest %.4f of %llu floats\n", largest, static_cast<unsigned long long>(total));
  EXPECT_EQ(total, std::uint64_t{minus_87} - minus_zero + 1);
  EXPECT_LE(largest, test::tolerance::exp_ulps);
}

TEST(ExpOfEveryFloat, IsZeroBelowTheUnderflow) {
  for (std::uint64_t bits = std::uint64_t{minus_87} + 1; bits <= minus_infinity; ++bits)
    ASSERT_EQ(kernel::rpf_exp(float_of(static_cast<std::uint32_t>(bits))), 0.0F) << std::hex << bits;
}

constexpr const char* exp_of_floats = R"(
__kernel void exp_of_floats(uint first, __global float* scalar, __global float* vector) {
  const uint i = (uint)get_global_id(0);
  const uint16 bits = first + i * 16 + (uint16)(0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15);
  vstore16(rpf_exp(as_float16(bits)), i, vector);
  for (uint l = 0; l < 16; ++l) scalar[i * 16 + l] = rpf_exp(as_float(first + i * 16 + l));
})";

// From -0 to -infinity and some NaN, as a scalar and as one of 16 values.
TEST(ExpOfEveryFloat, HasTheReferencesBitsOnTheDevice) {
  if (test::backend_under_test() == "cpu") GTEST_SKIP() << "this is the reference";
  constexpr std::size_t chunk = 1U << 22;
  const cl::Device device = all_devices().at(static_cast<std::size_t>(find_device("")));
  const cl::Context context(device);
  cl::CommandQueue queue(context, device);
  const cl::Program program(context, kernel_source("numeric.h") + exp_of_floats);
  program.build("-cl-std=CL1.2");
  cl::Kernel kernel(program, "exp_of_floats");
  const cl::Buffer buffers[] = {cl::Buffer(context, CL_MEM_READ_WRITE, chunk * sizeof(float)),
                                cl::Buffer(context, CL_MEM_READ_WRITE, chunk * sizeof(float))};
  std::vector<float> expected(chunk), got(chunk);
  for (std::uint64_t first = minus_zero; first <= minus_infinity; first += chunk) {
    for (std::size_t i = 0; i < chunk; ++i)
      expected[i] = kernel::rpf_exp(float_of(static_cast<std::uint32_t>(first + i)));
    kernel.setArg(0, static_cast<cl_uint>(first));
    for (cl_uint b = 0; b < 2; ++b) kernel.setArg(b + 1, buffers[b]);
    queue.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(chunk / 16));
    for (const cl::Buffer& buffer : buffers) {
      queue.enqueueReadBuffer(buffer, CL_TRUE, 0, chunk * sizeof(float), got.data());
      ASSERT_EQ(std::memcmp(got.data(), expected.data(), chunk * sizeof(float)), 0) << std::hex << "from " << first;
    }
  }
}

}  // namespace
}  // namespace rpf
