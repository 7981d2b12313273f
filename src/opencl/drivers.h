// The drivers that are installed, as OpenCL's loader looks for them.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace rpf {

struct InstalledDriver {
  std::filesystem::path file;  ///< that names it: an .icd file, or the library itself
  std::string library;         ///< as the loader hands it to dlopen()
};

/// By OCL_ICD_VENDORS (a folder, an .icd file, or a library), OPENCL_VENDOR_PATH, or /etc/OpenCL/vendors: the rules of
/// ocl-icd, libOpenCL(7).
std::vector<InstalledDriver> installed_drivers();

/// Those whose library this process cannot load, a text each: the file that names it, and the loader's reason. Loads
/// them once more, so only after the drivers were listed here.
std::vector<std::string> failures_to_load();

}  // namespace rpf
