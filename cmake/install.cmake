# cmake --install, in the three parts that distributions make packages of: the library, what programs are built with, the command.
include(CMakePackageConfigHelpers)
set(RPF_PARTS_FOLDER ${CMAKE_INSTALL_LIBDIR}/rpf)               # what the library starts and loads by itself (src/parts)
set(RPF_CMAKE_FOLDER ${CMAKE_INSTALL_LIBDIR}/cmake/rpf)

install(TARGETS rpf_shared EXPORT rpf
  LIBRARY DESTINATION ${CMAKE_INSTALL_LIBDIR} COMPONENT library NAMELINK_COMPONENT development)
install(TARGETS rpf_probe RUNTIME DESTINATION ${RPF_PARTS_FOLDER} COMPONENT library)
install(TARGETS rpf_images LIBRARY DESTINATION ${RPF_PARTS_FOLDER} COMPONENT library)

install(DIRECTORY include/rpf DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT development)
install(EXPORT rpf NAMESPACE rpf:: FILE rpfTargets.cmake DESTINATION ${RPF_CMAKE_FOLDER} COMPONENT development)
configure_package_config_file(cmake/rpfConfig.cmake.in rpfConfig.cmake INSTALL_DESTINATION ${RPF_CMAKE_FOLDER})
# Before 1.0.0 a minor version may change the interface.
write_basic_package_version_file(rpfConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/rpfConfig.cmake ${CMAKE_CURRENT_BINARY_DIR}/rpfConfigVersion.cmake
  DESTINATION ${RPF_CMAKE_FOLDER} COMPONENT development)
file(RELATIVE_PATH RPF_FROM_PKGCONFIG_TO_PREFIX "${CMAKE_INSTALL_FULL_LIBDIR}/pkgconfig" "${CMAKE_INSTALL_PREFIX}")
configure_file(cmake/rpf.pc.in rpf.pc @ONLY)
install(FILES ${CMAKE_CURRENT_BINARY_DIR}/rpf.pc DESTINATION ${CMAKE_INSTALL_LIBDIR}/pkgconfig COMPONENT development)

install(TARGETS rpf_command RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT command)
