# Debian packages of the three parts: cmake --workflow --preset package leaves them in build/packages.
find_program(RPF_GZIP gzip REQUIRED)  # manual page and changelog, as Debian keeps them

# ---- manual page and completion, made from the texts of the options -----------------------------------------------------
set(RPF_MANUAL ${CMAKE_CURRENT_BINARY_DIR}/manual)
file(MAKE_DIRECTORY ${RPF_MANUAL})
add_custom_command(OUTPUT ${RPF_MANUAL}/rpf.1.gz ${RPF_MANUAL}/rpf.bash ${RPF_MANUAL}/_rpf ${RPF_MANUAL}/rpf.fish
  COMMAND rpf_command manual man > rpf.1
  COMMAND ${RPF_GZIP} -9nf rpf.1
  COMMAND rpf_command manual bash > rpf.bash
  COMMAND rpf_command manual zsh > _rpf
  COMMAND rpf_command manual fish > rpf.fish
  WORKING_DIRECTORY ${RPF_MANUAL} DEPENDS rpf_command VERBATIM)
add_custom_target(rpf_manual ALL DEPENDS ${RPF_MANUAL}/rpf.1.gz)
install(FILES ${RPF_MANUAL}/rpf.1.gz DESTINATION ${CMAKE_INSTALL_MANDIR}/man1 COMPONENT command)
install(FILES ${RPF_MANUAL}/rpf.bash DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions RENAME rpf COMPONENT command)
install(FILES ${RPF_MANUAL}/_rpf DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT command)
install(FILES ${RPF_MANUAL}/rpf.fish DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT command)

# Who answers for the packages that are built here, as Debian's own tools ask for it. An address that ends in .invalid
# is nobody's (RFC 2606).
set(maintainer "local build of rpf <nobody@rpf.invalid>")
if(DEFINED ENV{DEBFULLNAME} AND DEFINED ENV{DEBEMAIL})
  set(maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
set(RPF_MAINTAINER "${maintainer}" CACHE STRING "Maintainer of the Debian packages: name <address>")

# ---- the packages -------------------------------------------------------------------------------------------------------
set(CPACK_PACKAGE_NAME rpf)
set(CPACK_PACKAGE_VENDOR "rpf")
set(CPACK_PACKAGE_CONTACT "${RPF_MAINTAINER}")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_COMPONENTS_ALL library development command)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_RELEASE 1)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS_PRIVATE_DIRS ${CMAKE_CURRENT_BINARY_DIR})
set(CPACK_DEBIAN_PACKAGE_CONTROL_STRICT_PERMISSION ON)

# Appends to a package's settings: name, section, description, and documents that Debian asks for.
function(describe_package component name section summary text)
  string(TOUPPER ${component} key)
  set(CPACK_DEBIAN_${key}_PACKAGE_NAME ${name} PARENT_SCOPE)
  set(CPACK_DEBIAN_${key}_PACKAGE_SECTION ${section} PARENT_SCOPE)
  set(CPACK_COMPONENT_${key}_DESCRIPTION "${summary}\n${text}" PARENT_SCOPE)
  install(FILES ${CMAKE_CURRENT_SOURCE_DIR}/cmake/package/copyright DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} COMPONENT ${component})
  install(FILES ${RPF_MANUAL}/changelog.gz DESTINATION ${CMAKE_INSTALL_DATADIR}/doc/${name} RENAME changelog.Debian.gz COMPONENT ${component})
endfunction()
string(TIMESTAMP RPF_PACKAGE_DATE "%a, %d %b %Y %H:%M:%S +0000" UTC)
configure_file(cmake/package/changelog.in ${RPF_MANUAL}/changelog @ONLY)
execute_process(COMMAND ${RPF_GZIP} -9nkf changelog WORKING_DIRECTORY ${RPF_MANUAL} COMMAND_ERROR_IS_FATAL ANY)

describe_package(library librpf${PROJECT_VERSION_MAJOR} libs "filter of Monte Carlo renderings, shared library"
  "Removes the noise of lens, motion, soft shadow and gloss from the samples of\na renderer, by weights over what was rendered. Programs need it to run.")
describe_package(development librpf-dev libdevel "filter of Monte Carlo renderings, development files"
  "Headers for C++17 and C, and files for CMake and pkg-config.")
describe_package(command rpf graphics "filter of Monte Carlo renderings from their samples"
  "Removes the noise of lens, motion, soft shadow and gloss from the samples of\na renderer, by weights over what was rendered; reads deep OpenEXR files.")
set(same_version "(= ${PROJECT_VERSION}-1)")
# CPack's own would be scripts that call ldconfig, which Debian does by a trigger.
file(WRITE ${RPF_MANUAL}/triggers "activate-noawait ldconfig\n")
file(WRITE ${RPF_MANUAL}/shlibs "librpf ${PROJECT_VERSION_MAJOR} librpf${PROJECT_VERSION_MAJOR} (>= ${PROJECT_VERSION})\n")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_CONTROL_EXTRA "${RPF_MANUAL}/triggers;${RPF_MANUAL}/shlibs")
set(CPACK_DEBIAN_LIBRARY_PACKAGE_RECOMMENDS "pocl-opencl-icd | opencl-icd")   # OpenCL on a processor
set(CPACK_DEBIAN_LIBRARY_PACKAGE_SUGGESTS "libembree3-3")                     # render_scene()
set(CPACK_DEBIAN_DEVELOPMENT_PACKAGE_DEPENDS "librpf${PROJECT_VERSION_MAJOR} ${same_version}")
# The command carries the library; the other package has what both start and load (src/parts).
set(CPACK_DEBIAN_COMMAND_PACKAGE_DEPENDS "librpf${PROJECT_VERSION_MAJOR} ${same_version}")
set(CPACK_DEBIAN_COMMAND_PACKAGE_RECOMMENDS "libembree3-3, gnuplot-nox")      # rpf scene; rpf study
include(CPack)
