# Turns the files of kernels/ into one C++ file, so that the library carries them: rpf::kernel_files().
file(GLOB RPF_KERNEL_FILES CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/kernels/*.h ${PROJECT_SOURCE_DIR}/kernels/*.cl)
set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${RPF_KERNEL_FILES})
set(entries "")
foreach(file IN LISTS RPF_KERNEL_FILES)
  get_filename_component(name ${file} NAME)
  file(READ ${file} text)
  string(APPEND entries "    {\"${name}\", R\"kernel(${text})kernel\"},\n")
endforeach()
file(CONFIGURE OUTPUT kernel_files.cpp @ONLY CONTENT "// Generated from kernels/ by cmake/embed_kernels.cmake.
#include \"opencl/kernel_source.h\"

namespace rpf {

const std::map<std::string, std::string>& kernel_files() {
  static const std::map<std::string, std::string> files = {
@entries@  };
  return files;
}

}  // namespace rpf
")
