#include "rpf/devices.h"

#include "opencl/drivers.h"
#include "opencl/probe.h"
#include "opencl/session.h"

namespace rpf {
namespace {

std::string type_of(const cl::Device& device) {
  const cl_device_type type = device.getInfo<CL_DEVICE_TYPE>();
  if ((type & CL_DEVICE_TYPE_CPU) != 0) return "cpu";
  if ((type & CL_DEVICE_TYPE_GPU) != 0) return "gpu";
  return (type & CL_DEVICE_TYPE_ACCELERATOR) != 0 ? "accelerator" : "other";
}

DeviceInfo describe(const cl::Device& device, int index) {
  DeviceInfo info;
  info.index = index;
  info.platform = cl::Platform(device.getInfo<CL_DEVICE_PLATFORM>()).getInfo<CL_PLATFORM_NAME>();
  info.name = device.getInfo<CL_DEVICE_NAME>();
  info.driver = device.getInfo<CL_DRIVER_VERSION>();
  info.version = device.getInfo<CL_DEVICE_VERSION>();
  info.type = type_of(device);
  info.compute_units = static_cast<int>(device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>());
  info.vector_width = static_cast<int>(device.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT>());
  info.memory = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
  info.largest_buffer = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
  return info;
}

}  // namespace

std::vector<DeviceInfo> devices() {
  probe_drivers();
  return on_device("listing the devices", [] {
    std::vector<DeviceInfo> result;
    for (const cl::Device& device : all_devices()) result.push_back(describe(device, static_cast<int>(result.size())));
    return result;
  });
}

std::vector<std::string> unloaded_drivers() {
  devices();
  return failures_to_load();
}

std::string check_device(int index) { return probe_device(index); }

}  // namespace rpf
