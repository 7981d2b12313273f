#include "opencl/session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <mutex>

#include "opencl/address_space.h"
#include "opencl/affinity.h"
#include "opencl/drivers.h"
#include "opencl/kernel_cache.h"
#include "opencl/kernel_source.h"
#include "opencl/machine_state.h"
#include "opencl/probe.h"
#include "opencl/target.h"

namespace rpf {
namespace {

constexpr int no_platform = -1001;  // CL_PLATFORM_NOT_FOUND_KHR of the ICD loader

std::string lower(std::string text) {
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

std::string names_of(const std::vector<cl::Device>& devices) {
  std::string text;
  for (std::size_t i = 0; i < devices.size(); ++i)
    text += fmt::format("{}{} '{}'", i == 0 ? "" : ", ", i, devices[i].getInfo<CL_DEVICE_NAME>());
  return text;
}

/// -1 where the text is no index.
int index_of(const std::string& text, std::size_t count) {
  const bool digits =
      !text.empty() && std::all_of(text.begin(), text.end(), [](char c) { return c >= '0' && c <= '9'; });
  if (!digits || text.size() > 6) return -1;
  const int index = std::stoi(text);
  return static_cast<std::size_t>(index) < count ? index : -1;
}

/// What could not be loaded, behind a statement about what is there.
std::string failures_in_brackets() {
  const std::vector<std::string> failures = failures_to_load();
  return failures.empty() ? "" : fmt::format(" ({})", fmt::join(failures, "; "));
}

std::string key_of(const std::string& file, const std::string& definitions, const std::string& more) {
  return file + " " + definitions + "\n" + more;
}

/// Empty where the driver has none for us.
Binaries::Binary binary_of(const cl::Program& program) {
  try {
    return program.getInfo<CL_PROGRAM_BINARIES>().at(0);
  } catch (const cl::Error&) {
    return {};
  }
}

/// No option that trades accuracy; division and square root correctly rounded where that must be asked for. No
/// warnings: the compiler counts them on standard error, past every -q, and the build has looked at them (tests,
/// kernels.*).
std::string build_options(const cl::Device& device, const std::string& definitions) {
  const bool asks = (device.getInfo<CL_DEVICE_SINGLE_FP_CONFIG>() & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT) != 0;
  return "-cl-std=CL1.2 -w " + std::string(asks ? "-cl-fp32-correctly-rounded-divide-sqrt " : "") +
         (has_avx2(device) ? "-DRPF_AVX2 " : "") + (has_new_avx512(device) ? "-DRPF_AVX512 " : "") + definitions;
}

}  // namespace

std::vector<cl::Device> all_devices() {
  static std::once_flag started;
  std::call_once(started, check_address_space_to_start);  // once more where it throws
  prepare_kernel_cache();
  keep_driver_threads_apart();
  std::vector<cl::Device> result;
  try {
    std::vector<cl::Platform> platforms;
    cl::Platform::get(&platforms);
    for (const cl::Platform& platform : platforms) {
      std::vector<cl::Device> devices;
      try {
        platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
      } catch (const cl::Error& e) {
        if (e.err() != CL_DEVICE_NOT_FOUND) throw;
      }
      result.insert(result.end(), devices.begin(), devices.end());
    }
  } catch (const cl::Error& e) {
    if (e.err() != no_platform) throw;
  }
  return result;
}

int find_device(const std::string& wanted) {
  require_working_device(wanted);
  return listed_device(wanted);
}

int listed_device(const std::string& wanted) {
  const std::vector<cl::Device> devices = on_device("listing the devices", all_devices);
  if (devices.empty())
    throw Error(
        ErrorKind::device,
        fmt::format(
            "no OpenCL device is there{}; install one (Debian: apt-get install pocl-opencl-icd) or use --backend=cpu",
            failures_in_brackets()));
  if (wanted.empty()) return 0;
  if (const int index = index_of(wanted, devices.size()); index >= 0) return index;
  int found = -1;
  for (std::size_t i = 0; i < devices.size(); ++i) {
    if (lower(devices[i].getInfo<CL_DEVICE_NAME>()).find(lower(wanted)) == std::string::npos) continue;
    if (found >= 0)
      throw Error(ErrorKind::usage,
                  fmt::format("--device '{}' fits several devices; there are: {}", wanted, names_of(devices)));
    found = static_cast<int>(i);
  }
  if (found < 0)
    throw Error(ErrorKind::device, fmt::format("--device '{}': no such device; there are: {}{}", wanted,
                                               names_of(devices), failures_in_brackets()));
  return found;
}

Session& Session::of(int device) {
  static std::mutex mutex;
  static auto& sessions = *new std::map<int, Session>();  // never destroyed: see the header
  const std::lock_guard<std::mutex> lock(mutex);
  const auto found = sessions.find(device);
  if (found != sessions.end()) return found->second;
  return on_device("opening the device", [&]() -> Session& {
    return sessions.emplace(device, Session(all_devices().at(static_cast<std::size_t>(device)), device)).first->second;
  });
}

Session::Session(cl::Device device, int number)
    : device_(std::move(device)), number_(number), context_(device_), queue_(context_, device_) {}

std::string Session::source_of(const std::string& file, const std::string& definitions, const std::string& more) const {
  return fmt::format("{}\n{}\n{}{}\n{}{}", device_.getInfo<CL_DEVICE_NAME>(), device_.getInfo<CL_DRIVER_VERSION>(),
                     processor_state(), build_options(device_, definitions), kernel_source(file), more);
}

void Session::rehearse(const std::string& file, const std::string& definitions, const std::string& more,
                       const Check& check) {
  if (programs_.count(key_of(file, definitions, more)) != 0) return;
  require_compiled({number_, file, definitions, more, source_of(file, definitions, more), is_pocl(device_)}, check);
}

const cl::Program& Session::program(const std::string& file, const std::string& definitions, const std::string& more) {
  rehearse(file, definitions, more, {});
  return compile(file, definitions, more);
}

const cl::Program& Session::compile(const std::string& file, const std::string& definitions, const std::string& more) {
  const std::string key = key_of(file, definitions, more);
  if (const auto found = programs_.find(key); found != programs_.end()) return found->second;
  check_address_space_to_compile();
  const std::string source = source_of(file, definitions, more);
  if (is_pocl(device_)) check_kernels(source);
  const cl::Program program =
      is_pocl(device_) ? build(file, definitions, more) : build_kept(source, file, definitions, more);
  sources_[program()] = source;
  return programs_.emplace(key, program).first->second;
}

cl::Program Session::build(const std::string& file, const std::string& definitions, const std::string& more) {
  cl::Program program(context_, kernel_source(file) + more);
  try {
    program.build(device_, build_options(device_, definitions).c_str());
  } catch (const cl::Error& e) {
    throw Error(ErrorKind::device,
                fmt::format("compiling {} for '{}' failed ({}), please report it; --backend=cpu works without. "
                            "Options: {}\n{}",
                            file, device_.getInfo<CL_DEVICE_NAME>(), e.err(), definitions,
                            program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device_)));
  }
  return program;
}

cl::Program Session::build_kept(const std::string& source, const std::string& file, const std::string& definitions,
                                const std::string& more) {
  const Binaries binaries(binary_folder());
  const Binaries::Binary known = binaries.find(source);
  if (cl::Program program = load(known); program() != nullptr) return program;
  cl::Program compiled = build(file, definitions, more);
  if (known.empty() && binaries.has(source)) return compiled;  // it was tried
  binaries.keep(source, binary_of(compiled));
  if (cl::Program program = load(binaries.find(source)); program() != nullptr)
    return program;  // what is used now is what later starts use
  binaries.keep(source, {});
  return compiled;
}

cl::Program Session::load(const Binaries::Binary& binary) {
  if (binary.empty()) return {};
  try {
    cl::Program program(context_, {device_}, {binary});
    program.build(device_);
    return program;
  } catch (const cl::Error&) {
    return {};
  }
}

void Session::launch(const cl::Kernel& kernel, std::size_t items, std::size_t group) {
  enqueue(kernel, items, group);
  finish();
}

void Session::enqueue(const cl::Kernel& kernel, std::size_t items, std::size_t group) {
  const cl_program program = kernel.getInfo<CL_KERNEL_PROGRAM>()();
  const std::string name = fmt::format("{} of {}", kernel.getInfo<CL_KERNEL_FUNCTION_NAME>(), fmt::ptr(program));
  const bool is_new = launched_.insert(name).second;
  if (is_new) check_address_space_to_compile();
  queue_.enqueueNDRangeKernel(kernel, cl::NullRange, cl::NDRange(items), cl::NDRange(group));
  if (!is_new) return;
  finish();
  if (is_pocl(device_)) keep_compiled_kernels(sources_[program]);
}

void Session::finish() {
  queue_.finish();
  canaries_.check(queue_);
}

cl::Event Session::mark() {
  cl::Event event;
  queue_.enqueueMarkerWithWaitList(nullptr, &event);
  queue_.flush();
  return event;
}

cl::Buffer Session::copy_of(const void* data, std::size_t bytes) {
  cl::Buffer result = buffer(std::max<std::size_t>(bytes, sizeof(float)));
  if (bytes > 0) queue_.enqueueWriteBuffer(result, CL_TRUE, 0, bytes, data);
  return result;
}

cl::Buffer Session::host_buffer(const void* data, std::size_t bytes, cl_mem_flags access) {
  if (has_canaries || bytes == 0) return copy_of(data, bytes);
  return {context_, access | CL_MEM_USE_HOST_PTR, bytes, const_cast<void*>(data)};
}

void Session::read_back(const cl::Buffer& buffer, std::size_t offset, std::size_t bytes, void* data) {
  if (bytes == 0) return;
  if (has_canaries) {
    queue_.enqueueReadBuffer(buffer, CL_TRUE, offset, bytes, static_cast<char*>(data) + offset);
    return;
  }
  void* mapped = queue_.enqueueMapBuffer(buffer, CL_TRUE, CL_MAP_READ, offset, bytes);
  queue_.enqueueUnmapMemObject(buffer, mapped);
  queue_.finish();
}

}  // namespace rpf
