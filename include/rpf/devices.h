// OpenCL devices: what there is, and whether it keeps the numeric contract (docs/numerics.md).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace rpf {

/// One OpenCL device as `rpf devices` lists it.
struct DeviceInfo {
  int index = 0;  ///< what Settings::device accepts, beside a part of the name
  std::string platform, name, driver, version;
  std::string type;                  ///< "cpu", "gpu", "accelerator" or "other"
  int compute_units = 0;             ///< 0 .. as the driver says
  int vector_width = 0;              ///< native floats a vector; 1 where the device works item by item
  std::uint64_t memory = 0;          ///< bytes of global memory
  std::uint64_t largest_buffer = 0;  ///< bytes of one allocation
};

/// All devices of all platforms, numbered in the order in which the platforms name them. Empty where there is none.
/// Sets POCL_CACHE_DIR, where nobody has, to a folder of our own below RPF_CACHE_DIR, XDG_CACHE_HOME or HOME.
std::vector<DeviceInfo> devices();

/// Installed OpenCL drivers that this process cannot load, a text each: the file that names the driver, and the
/// loader's reason. Throws Error(device) as devices() does.
std::vector<std::string> unloaded_drivers();

/// Computes on a device what the numeric contract promises and compares every bit with the host's results. Empty where
/// all agree, else the first disagreement. Throws Error(device) where the device cannot be used at all.
std::string check_device(int index);

}  // namespace rpf
