#include "opencl/machine_state.h"

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <sys/utsname.h>
#include <unistd.h>
#ifdef __x86_64__
#include <cpuid.h>
#endif

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <vector>

#include "opencl/drivers.h"
#include "opencl/environment.h"
#include "opencl/kernel_cache.h"
#include "rpf/version.h"

namespace rpf {
namespace {

namespace fs = std::filesystem;

std::vector<std::string> split(const std::string& list) {
  std::vector<std::string> parts;
  std::istringstream text(list);
  for (std::string part; std::getline(text, part, ':');) parts.push_back(part);
  return parts;
}

/// Which file it is, and when it changed; empty where there is none.
std::string file_state(const fs::path& path) {
  struct stat file {};
  if (::stat(path.c_str(), &file) != 0) return {};
  return fmt::format("{} {} {} {} {}.{}\n", path.string(), file.st_dev, file.st_ino, file.st_size, file.st_mtim.tv_sec,
                     file.st_mtim.tv_nsec);
}

/// The first file of that name in these folders.
std::string first_found(const std::string& name, const std::vector<std::string>& folders) {
  for (const std::string& folder : folders)
    if (const std::string state = file_state(fs::path(folder) / name); !state.empty()) return state;
  return name + " is nowhere\n";
}

std::string system_state() {
  utsname name{};
  ::uname(&name);
  return fmt::format("rpf {}\n{} {} {}\nuser {}\n{}", version(), name.nodename, name.release, name.machine, ::geteuid(),
                     processor_state());
}

/// Of the loader, OpenCL's and the drivers'.
std::string environment_state() {
  constexpr const char* prefixes[] = {"PATH=", "LD_", "OCL_", "OPENCL_", "POCL_",
                                      "CUDA_", "ROC", "HIP_", "GPU_",    "TMPDIR="};
  std::vector<std::string> found;
  for (char** entry = environ; *entry != nullptr; ++entry)
    for (const std::string prefix : prefixes)
      if (prefix.compare(0, prefix.size(), *entry, std::min(prefix.size(), std::string(*entry).size())) == 0)
        found.emplace_back(*entry);
  std::sort(found.begin(), found.end());
  std::string text;
  for (const std::string& entry : found) text += entry + "\n";
  return text;
}

/// The files that name the drivers, and the libraries that they name.
std::string driver_state() {
  std::vector<std::string> libraries = split(environment("LD_LIBRARY_PATH"));
  for (const char* folder :
       {"/usr/local/lib", "/usr/lib/x86_64-linux-gnu", "/usr/lib/aarch64-linux-gnu", "/usr/lib64", "/usr/lib"})
    libraries.emplace_back(folder);
  std::string text;
  for (const InstalledDriver& driver : installed_drivers())
    text += file_state(driver.file) + first_found(driver.library, libraries);
  return text;
}

std::string limits() {
  std::string text;
  for (const auto kind : {RLIMIT_AS, RLIMIT_DATA, RLIMIT_FSIZE, RLIMIT_NOFILE, RLIMIT_NPROC, RLIMIT_STACK}) {
    rlimit limit{};
    ::getrlimit(kind, &limit);
    text += fmt::format("{} ", limit.rlim_cur);
  }
  return text + "\n";
}

/// What drivers read of the machine, and where they write: a file system that does not run programs matters.
std::string mounts() {
  std::string text;
  for (const char* path : {"/sys/devices/system/cpu", "/sys/devices/system/node", "/proc/cpuinfo", "/proc/meminfo",
                           "/dev/shm", "/dev/dri", "/dev/kfd", "/dev/nvidiactl"})
    text += fmt::format("{} {}\n", path, ::access(path, R_OK) == 0);
  for (const fs::path& folder : {fs::path("/tmp"), kernel_cache_folder()}) {
    struct statvfs system {};
    struct stat place {};
    if (::statvfs(folder.c_str(), &system) == 0 && ::stat(folder.c_str(), &place) == 0)
      text += fmt::format("{} {} {}\n", folder.string(), place.st_dev, system.f_flag);
  }
  return text;
}

}  // namespace

std::string processor_state() {
#ifdef __x86_64__
  std::string text;
  for (const unsigned leaf : {1U, 7U, 0x80000002U, 0x80000003U, 0x80000004U}) {
    unsigned a = 0, b = 0, c = 0, d = 0;
    if (__get_cpuid_count(leaf, 0, &a, &b, &c, &d) == 0) continue;
    text += fmt::format("{:x} {:x} {:x} {:x}\n", a, leaf == 1 ? 0 : b, c, d);  // b of leaf 1 says which core this is
  }
  return text;
#else
  return {};
#endif
}

std::string machine_state() {
  return system_state() + environment_state() + driver_state() + first_found("ld", split(environment("PATH"))) +
         limits() + mounts();
}

}  // namespace rpf
