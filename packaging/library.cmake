# Installs the library: headers, CMake package, pkg-config.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(cmake_dir ${CMAKE_INSTALL_LIBDIR}/cmake/poise)
set(pkgconfig_dir ${CMAKE_INSTALL_LIBDIR}/pkgconfig)

install(TARGETS poise EXPORT poise-targets COMPONENT development)
install(DIRECTORY include/poise TYPE INCLUDE COMPONENT development FILES_MATCHING PATTERN "*.hpp")
install(EXPORT poise-targets NAMESPACE poise:: DESTINATION ${cmake_dir} COMPONENT development)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/poise-config-version.cmake
  COMPATIBILITY SameMinorVersion)
install(FILES packaging/poise-config.cmake ${PROJECT_BINARY_DIR}/poise-config-version.cmake
  DESTINATION ${cmake_dir} COMPONENT development)

# Seen from the installed file, so that the whole can be moved.
file(RELATIVE_PATH prefix_from_pkgconfig
  ${CMAKE_INSTALL_PREFIX}/${pkgconfig_dir} ${CMAKE_INSTALL_PREFIX})
configure_file(packaging/poise.pc.in ${PROJECT_BINARY_DIR}/poise.pc @ONLY)
install(FILES ${PROJECT_BINARY_DIR}/poise.pc DESTINATION ${pkgconfig_dir} COMPONENT development)
