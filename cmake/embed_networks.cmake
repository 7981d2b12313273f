# Carries the files of networks/ in the library: rpf::embedded_networks(). The assembler reads them (4 MB as text would
# take a compiler minutes).
file(GLOB RPF_NETWORK_FILES CONFIGURE_DEPENDS ${PROJECT_SOURCE_DIR}/networks/*.rpfnet)
set(data "")
set(symbols "")
set(entries "")
foreach(file IN LISTS RPF_NETWORK_FILES)
  get_filename_component(name ${file} NAME_WE)
  string(APPEND data "asm(R\"(.section .rodata\n.balign 16\nrpf_network_${name}:\n.incbin \"${file}\"\nrpf_network_${name}_end:\n.previous)\");\n")
  string(APPEND symbols "extern \"C\" const char rpf_network_${name}[], rpf_network_${name}_end[];\n")
  string(APPEND entries "      {\"${name}\", {rpf_network_${name}, static_cast<std::size_t>(rpf_network_${name}_end - rpf_network_${name})}},\n")
endforeach()
file(CONFIGURE OUTPUT network_files.cpp @ONLY CONTENT "// Generated from networks/ by cmake/embed_networks.cmake.
#include \"learned/network_file.h\"

@data@
@symbols@
namespace rpf {

const std::vector<EmbeddedNetwork>& embedded_networks() {
  static const std::vector<EmbeddedNetwork> networks = {
@entries@  };
  return networks;
}

}  // namespace rpf
")
set_source_files_properties(${CMAKE_CURRENT_BINARY_DIR}/network_files.cpp PROPERTIES OBJECT_DEPENDS "${RPF_NETWORK_FILES}")
