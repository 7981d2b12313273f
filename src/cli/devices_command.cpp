
#include "cli/commands.h"
#include "cli/print.h"
#include "rpf/devices.h"
#include "rpf/error.h"

namespace rpf::cli {
namespace {

constexpr double gigabyte = 1024 * megabyte;

/// What the self-test says of a device; a device that fails is listed all the same.
std::string verdict(int index) {
  try {
    const std::string failure = check_device(index);
    return failure.empty() ? "keeps the numeric contract: the bits of --backend=cpu" : "not used: " + failure;
  } catch (const Error& e) {
    return std::string("not used: ") + e.what();
  }
}

void print_device(const DeviceInfo& d) {
  print("{} {}\n", d.index, d.name);
  print("  {} on {}, driver {}, {}\n", d.type, d.platform, d.driver, d.version);
  print("  {} compute units, {} floats a vector, {:.1f} GB memory, largest buffer {:.1f} GB\n", d.compute_units,
        d.vector_width, static_cast<double>(d.memory) / gigabyte, static_cast<double>(d.largest_buffer) / gigabyte);
  print("  {}\n", verdict(d.index));
}

}  // namespace

Command add_devices_command(CLI::App& app) {
  app.add_subcommand("devices", "List the OpenCL devices for --device, and whether they keep the numeric contract");
  return [] {
    const std::vector<DeviceInfo> found = devices();
    for (const DeviceInfo& device : found) print_device(device);
    if (found.empty())
      print("no OpenCL device; install one (Debian: apt-get install pocl-opencl-icd), or use --backend=cpu\n");
    for (const std::string& failure : unloaded_drivers()) print("{}\n", failure);
    return 0;
  };
}

}  // namespace rpf::cli
