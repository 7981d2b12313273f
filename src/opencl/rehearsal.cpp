#include "opencl/rehearsal.h"

#include <array>
#include <iostream>
#include <iterator>
#include <sstream>
#include <vector>

#include "opencl/kernel_cache.h"
#include "opencl/kernel_source.h"
#include "opencl/probe.h"
#include "opencl/self_test.h"

namespace rpf {
namespace {

constexpr std::size_t buffer_bytes = 64 << 10, largest_argument = 1024;

/// Zeros, of the one size that the driver accepts, or more of them than enough: PoCL does not know the size of
/// structures.
void set_to_zeros(cl::Kernel& kernel, cl_uint number) {
  const std::array<char, largest_argument> zeros{};
  for (std::size_t bytes = zeros.size(); bytes > 0; --bytes)
    if (clSetKernelArg(kernel(), number, bytes, zeros.data()) == CL_SUCCESS) return;
  throw Error(ErrorKind::internal, "a kernel has an argument of more than 1024 bytes; hand it over in a buffer");
}

/// Whether a kernel's parameters are buffers, by its text: of a program that was loaded the driver need not know it.
std::vector<bool> buffers_among_parameters(const std::string& kernel, const std::string& text) {
  const std::size_t begin = text.find("__kernel void " + kernel + "(");
  if (begin == std::string::npos) return {};
  std::istringstream parameters(text.substr(begin, text.find(')', begin) - begin));
  std::vector<bool> result;
  for (std::string parameter; std::getline(parameters, parameter, ',');)
    result.push_back(parameter.find("__global ") != std::string::npos);
  return result;
}

void set_arguments(cl::Kernel& kernel, const std::string& text, const cl::Buffer& buffer) {
  const auto name = kernel.getInfo<CL_KERNEL_FUNCTION_NAME>();
  const std::vector<bool> is_buffer = buffers_among_parameters(name, text);
  if (is_buffer.size() != kernel.getInfo<CL_KERNEL_NUM_ARGS>())
    throw Error(ErrorKind::internal,
                "kernel " + name + ": its text begins with \"__kernel void\", then parameters without brackets");
  for (cl_uint number = 0; number < is_buffer.size(); ++number) {
    if (is_buffer[number])
      kernel.setArg(number, buffer);
    else
      set_to_zeros(kernel, number);
  }
}

std::string answer(const std::vector<std::string>& question) {
  if (question.at(0) == "list") return "ok\n" + std::to_string(all_devices().size());
  if (question.at(0) == "test") {
    Session& session = Session::of(listed_device(question.at(1)));
    const std::string failure = self_test(session);
    return failure.empty() ? "ok\n" : "differs\n" + session.device().getInfo<CL_DEVICE_NAME>() + "\n" + failure;
  }
  if (question.at(0) == "build") {
    rehearse(Session::of(std::stoi(question.at(1))), question.at(2), question.at(3),
             {std::istreambuf_iterator<char>(std::cin), {}});
    return "ok\n";
  }
  throw Error(ErrorKind::usage, "rpf_probe: list, test DEVICE or build DEVICE FILE DEFINITIONS is expected");
}

}  // namespace

void rehearse(Session& session, const std::string& file, const std::string& definitions, const std::string& more) {
  on_device("a first run of " + file, [&] {
    cl::Program program = session.compile(file, definitions, more);
    std::vector<cl::Kernel> kernels;
    program.createKernels(&kernels);
    const std::string text = kernel_source(file) + more;
    const cl::Buffer zeros = session.copy(std::vector<char>(buffer_bytes, 0));
    for (cl::Kernel& kernel : kernels) {
      set_arguments(kernel, text, zeros);
      session.launch(kernel, 1, 1);
    }
    prune_programs();
  });
}

std::string answer_probe(const std::vector<std::string>& question) {
  try {
    return on_device("asking the driver", [&] { return answer(question); });
  } catch (const Error& e) {
    return std::to_string(static_cast<int>(e.kind())) + "\n" + e.what();
  }
}

}  // namespace rpf
