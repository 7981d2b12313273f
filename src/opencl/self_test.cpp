#include "opencl/self_test.h"

#include <fmt/format.h>

#include <cstring>
#include <numeric>
#include <vector>

#include "opencl/session.h"
#include "rpf_math.h"

namespace rpf {
namespace {

constexpr std::size_t cases = 4096;  // a multiple of RPF_LANES

constexpr const char* operations[] = {
    "a * b + c in two roundings", "division",         "square root",       "exp", "exp of vectors",
    "vectors: a * b + c",         "vectors: sqrt, /", "integer arithmetic"};
constexpr std::size_t results = std::size(operations);

/// Floats of all signs and of magnitudes 2^-20 .. 2^20: nothing here may overflow or become subnormal.
std::vector<float> inputs(kernel::uint stream) {
  std::vector<float> values;
  for (kernel::uint i = 0; i < cases; ++i) {
    const kernel::rpf_words words = kernel::rpf_hash(i, stream, 0);
    const int exponent = static_cast<int>(words.x % 41U) - 20;
    const float mantissa = 1.0F + static_cast<float>(words.y >> 8) / 16777216.0F;
    values.push_back(std::ldexp((words.z & 1U) != 0 ? -mantissa : mantissa, exponent));
  }
  return values;
}

kernel::uint bits(float value) {
  kernel::uint result = 0;
  std::memcpy(&result, &value, sizeof result);
  return result;
}

/// What the contract says, in the order of `operations`.
std::vector<float> expected(float a, float b, float c, kernel::uint i) {
  const float product_sum = a * b + c, root = kernel::sqrt(kernel::fabs(a)),
              exponential = kernel::rpf_exp(-kernel::fabs(c));
  const auto hash = static_cast<float>(kernel::rpf_hash(bits(a), bits(b), i).x >> 8);
  return {product_sum, a / b, root, exponential, exponential, product_sum, root / b, hash};
}

/// What is wrong with results of single operations; empty if nothing.
std::string test_operations(Session& session, const cl::Program& program) {
  const std::vector<float> a = inputs(1), b = inputs(2), c = inputs(3);
  cl::Kernel kernel(program, "self_test");
  const cl::Buffer buffers[] = {session.copy(a), session.copy(b), session.copy(c),
                                session.buffer(cases * results * sizeof(float))};
  for (cl_uint i = 0; i < std::size(buffers); ++i) kernel.setArg(i, buffers[i]);
  session.launch(kernel, cases, RPF_LANES);
  const std::vector<float> device = session.read<float>(buffers[3], 0, cases * results);
  for (kernel::uint i = 0; i < cases; ++i) {
    const std::vector<float> host = expected(a[i], b[i], c[i], i);
    for (std::size_t r = 0; r < results; ++r)
      if (bits(host[r]) != bits(device[i * results + r]))
        return fmt::format("{} gives {:a} instead of {:a} for a = {:a}, b = {:a}, c = {:a}", operations[r],
                           device[i * results + r], host[r], a[i], b[i], c[i]);
  }
  return "";
}

/// The same of a sum of many values, which compilers may take in another order.
std::string test_sum(Session& session, const cl::Program& program) {
  const std::vector<float> values = inputs(1);
  cl::Kernel kernel(program, "self_test_sum");
  const cl::Buffer numbers = session.copy(values), sum = session.buffer(sizeof(float));
  kernel.setArg(0, numbers);
  kernel.setArg(1, sum);
  kernel.setArg(2, static_cast<cl_uint>(values.size()));
  session.launch(kernel, 1, 1);
  const float device = session.read<float>(sum, 0, 1).front(),
              host = std::accumulate(values.begin(), values.end(), 0.0F, kernel::rpf_added);
  if (bits(host) == bits(device)) return "";
  return fmt::format("additions in order give {:a} instead of {:a}", device, host);
}

}  // namespace

std::string self_test(Session& session) {
  return on_device("the self-test", [&] {
    const cl::Program program = session.compile("self_test.cl", "");
    const std::string fault = test_operations(session, program);
    return fault.empty() ? test_sum(session, program) : fault;
  });
}

}  // namespace rpf
