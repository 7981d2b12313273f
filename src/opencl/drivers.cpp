#include "opencl/drivers.h"

#include <dlfcn.h>
#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <system_error>

#include "opencl/environment.h"

namespace rpf {
namespace {

namespace fs = std::filesystem;

InstalledDriver named_by(const fs::path& file) {
  std::string library;
  std::ifstream content(file);
  std::getline(content, library);
  return {file, library};
}

std::vector<InstalledDriver> drivers_of(const fs::path& folder) {
  std::vector<InstalledDriver> drivers;
  std::error_code failed;
  for (fs::directory_iterator entry(folder, failed), end; !failed && entry != end; entry.increment(failed))
    if (entry->path().extension() == ".icd") drivers.push_back(named_by(entry->path()));
  std::sort(drivers.begin(), drivers.end(), [](const auto& a, const auto& b) { return a.file < b.file; });
  return drivers;
}

/// Empty where the library can be loaded.
std::string why_not_loaded(const std::string& library) {
  ::dlerror();
  void* loaded = ::dlopen(library.c_str(), RTLD_LAZY | RTLD_LOCAL);
  if (loaded == nullptr) return ::dlerror();
  const bool is_driver = ::dlsym(loaded, "clGetExtensionFunctionAddress") != nullptr;
  ::dlclose(loaded);
  return is_driver ? "" : library + ": this is no OpenCL driver";
}

}  // namespace

std::vector<InstalledDriver> installed_drivers() {
  const std::string wanted = environment("OCL_ICD_VENDORS"), folder = environment("OPENCL_VENDOR_PATH");
  const fs::path usual = folder.empty() ? "/etc/OpenCL/vendors" : folder;
  const fs::path chosen = wanted.empty() ? usual : fs::path(wanted);
  std::error_code failed;
  if (fs::is_directory(chosen, failed)) return drivers_of(chosen);
  if (wanted.empty()) return {};
  if (chosen.extension() != ".icd") return {{chosen, wanted}};
  const bool is_a_name = !chosen.has_parent_path();
  return {named_by(is_a_name && fs::exists(usual / chosen, failed) ? usual / chosen : chosen)};
}

std::vector<std::string> failures_to_load() {
  std::vector<std::string> texts;
  for (const InstalledDriver& driver : installed_drivers())
    if (const std::string reason = why_not_loaded(driver.library); !reason.empty())
      texts.push_back(fmt::format("{} cannot be loaded: {}", driver.file.string(), reason));
  return texts;
}

}  // namespace rpf
