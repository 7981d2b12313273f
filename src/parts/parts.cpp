#include "parts/parts.h"

#include <dlfcn.h>

#include <filesystem>
#include <system_error>

namespace rpf {
namespace {

namespace fs = std::filesystem;

/// Of librpf.so and the like; of a program something without use, as it was started.
fs::path folder_of_object() {
  static const char mark = 0;
  Dl_info object{};
  return ::dladdr(&mark, &object) != 0 && object.dli_fname != nullptr ? fs::path(object.dli_fname).parent_path() : "";
}

#ifdef RPF_BUILD_FOLDER
/// Not inline: so it stands in the program as a whole, where a test makes another folder of it.
[[gnu::noinline]] const char* build_folder() { return RPF_BUILD_FOLDER; }
#endif

}  // namespace

std::vector<std::string> places_of_part(const std::string& name) {
  std::error_code unknown;
  const fs::path program = fs::read_symlink("/proc/self/exe", unknown).parent_path(), object = folder_of_object();
  std::vector<fs::path> folders = {program};
  if (object.is_absolute()) folders.insert(folders.end(), {object, object / "rpf"});
  folders.push_back(program / RPF_FROM_PROGRAMS_TO_LIBRARIES / "rpf");
#ifdef RPF_BUILD_FOLDER
  folders.emplace_back(build_folder());
#endif
  std::vector<std::string> places;
  for (const fs::path& folder : folders) places.push_back((folder / name).string());
  return places;
}

}  // namespace rpf
