// A device in use: context, queue, compiled programs. One per device and process.
#pragma once

#include <algorithm>
#include <map>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

#include "opencl/opencl.h"
#include "rpf/error.h"

namespace rpf {

/// Runs `body`; an OpenCL failure becomes Error(device) that says what was being done.
template <typename Body>
decltype(auto) on_device(const std::string& what, Body body) {
  try {
    return body();
  } catch (const cl::Error& e) {
    throw Error(ErrorKind::device, "OpenCL: " + what + " failed: " + e.what() + " (" + std::to_string(e.err()) +
                                       "); try --backend=cpu, or another device of `rpf devices`");
  }
}

/// All devices, in the order of `rpf devices`. Empty where there is no platform.
std::vector<cl::Device> all_devices();

/// The device that an index or a part of a name stands for; the first one for an empty text. Throws Error(device) where
/// there is none and says what to install, Error(usage) where several fit.
int find_device(const std::string& wanted);

class Session {
 public:
  /// The session of a device, made at first use; it lives as long as the process (PoCL's clean-up is not to be relied
  /// on). The first use of a device tests the numeric contract: throws Error(device) where it is not kept.
  static Session& of(int device);
  /// The same without the test.
  static Session& untested(int device);

  explicit Session(cl::Device device);
  const cl::Device& device() const { return device_; }
  const cl::Context& context() const { return context_; }
  cl::CommandQueue& queue() { return queue_; }

  /// A program from kernels/`file`, compiled with these definitions ("-D..."), or what an earlier call compiled. Throws
  /// Error(device) with the build log.
  const cl::Program& program(const std::string& file, const std::string& definitions);

  /// A buffer that is the host's own memory where the device can do that. `bytes` 0 makes a small one.
  cl::Buffer host_buffer(const void* data, std::size_t bytes, cl_mem_flags access);
  /// A buffer of the device's own.
  cl::Buffer buffer(std::size_t bytes);
  /// Makes bytes that a kernel wrote into a host_buffer() visible in the host's memory.
  void read_back(const cl::Buffer& buffer, std::size_t offset, std::size_t bytes);
  /// A copy of `count` elements from `first` on.
  template <typename T>
  std::vector<T> read(const cl::Buffer& buffer, std::size_t first, std::size_t count) {
    std::vector<T> result(count);
    if (count > 0) queue_.enqueueReadBuffer(buffer, CL_TRUE, first * sizeof(T), count * sizeof(T), result.data());
    return result;
  }
  /// A read-only buffer with a copy of `data`.
  template <typename T>
  cl::Buffer copy(const std::vector<T>& data) {
    const std::size_t bytes = std::max<std::size_t>(data.size() * sizeof(T), sizeof(T));
    cl::Buffer result(context_, CL_MEM_READ_ONLY, bytes);
    if (!data.empty()) queue_.enqueueWriteBuffer(result, CL_TRUE, 0, data.size() * sizeof(T), data.data());
    return result;
  }

 private:
  cl::Device device_;
  cl::Context context_;
  cl::CommandQueue queue_;
  std::map<std::string, cl::Program> programs_;
};

}  // namespace rpf
