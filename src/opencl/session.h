// A device in use: context, queue, compiled programs. One per device and process.
#pragma once

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <vector>

#include "opencl/binaries.h"
#include "opencl/canaries.h"
#include "opencl/child.h"
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
/// The same of the devices that drivers list in this process, which none may have tried before: for rpf_probe.
int listed_device(const std::string& wanted);

class Session {
 public:
  /// The session of a device that find_device() found, made at first use; it lives as long as the process (PoCL's
  /// clean-up is not to be relied on).
  static Session& of(int device);

  Session(cl::Device device, int number);
  const cl::Device& device() const { return device_; }
  const cl::Context& context() const { return context_; }

  /// A program from kernels/`file`, with more text behind it, compiled with these definitions ("-D..."), or what an
  /// earlier call compiled. Throws Error(device) with the build log.
  const cl::Program& program(const std::string& file, const std::string& definitions, const std::string& more = "");
  /// What program() does first: a child compiles what no child has compiled yet (probe.h).
  void rehearse(const std::string& file, const std::string& definitions, const std::string& more, const Check& check);
  /// program() without that.
  const cl::Program& compile(const std::string& file, const std::string& definitions, const std::string& more = "");

  /// Runs a kernel over so many work-items in groups, and waits for it. PoCL compiles at the first launch.
  void launch(const cl::Kernel& kernel, std::size_t items, std::size_t group);
  /// The same without waiting, but for a kernel's first launch: what is asked for later comes after it. finish() waits.
  void enqueue(const cl::Kernel& kernel, std::size_t items, std::size_t group);
  void finish();
  /// An event that comes after all that was asked for.
  cl::Event mark();

  /// A buffer of the device's own.
  cl::Buffer buffer(std::size_t bytes) { return canaries_.allocate(context_, queue_, CL_MEM_READ_WRITE, bytes); }
  /// A buffer that is the host's own memory where the device can do that, else a copy; `bytes` 0 makes a small one.
  /// Debug builds always copy, as a device with memory of its own does.
  cl::Buffer host_buffer(const void* data, std::size_t bytes, cl_mem_flags access);
  /// The same of values that kernels only read.
  template <typename T>
  cl::Buffer input(const std::vector<T>& values) {
    return host_buffer(values.data(), values.size() * sizeof(T), CL_MEM_READ_ONLY);
  }
  /// Makes bytes that a kernel wrote into a host_buffer() visible in the host's memory, at `data` of the call above.
  void read_back(const cl::Buffer& buffer, std::size_t offset, std::size_t bytes, void* data);
  /// A buffer with a copy of `values`.
  template <typename T>
  cl::Buffer copy(const std::vector<T>& values) {
    return copy_of(values.data(), values.size() * sizeof(T));
  }
  /// A copy of `count` elements from `first` on.
  template <typename T>
  std::vector<T> read(const cl::Buffer& buffer, std::size_t first, std::size_t count) {
    std::vector<T> result(count);
    if (count > 0) queue_.enqueueReadBuffer(buffer, CL_TRUE, first * sizeof(T), count * sizeof(T), result.data());
    return result;
  }

 private:
  cl::Buffer copy_of(const void* data, std::size_t bytes);
  /// All that decides what is compiled.
  std::string source_of(const std::string& file, const std::string& definitions, const std::string& more) const;
  cl::Program build(const std::string& file, const std::string& definitions, const std::string& more);
  /// The same, of the binary that the driver has made of this source, here or earlier.
  cl::Program build_kept(const std::string& source, const std::string& file, const std::string& definitions,
                         const std::string& more);
  /// A program without a handle where the driver does not take the binary.
  cl::Program load(const Binaries::Binary& binary);

  cl::Device device_;
  int number_;
  cl::Context context_;
  cl::CommandQueue queue_;
  Canaries canaries_;
  std::map<std::string, cl::Program> programs_;  ///< by file, definitions and more text
  std::map<cl_program, std::string> sources_;    ///< what each was compiled from: text, options, device
  std::set<std::string> launched_;               ///< kernels that ran, with their program
};

}  // namespace rpf
