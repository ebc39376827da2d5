# The headers, the CMake package and the pkg-config file. All of it is text, so the same files serve every architecture.
include(GNUInstallDirs)
include(CMakePackageConfigHelpers)

set(package_dir ${CMAKE_INSTALL_DATADIR}/cmake/feeler)
write_basic_package_version_file(${PROJECT_BINARY_DIR}/feeler-config-version.cmake
  COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
configure_file(${CMAKE_CURRENT_LIST_DIR}/feeler.pc.in ${PROJECT_BINARY_DIR}/feeler.pc @ONLY)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
install(TARGETS feeler EXPORT feeler-targets)
install(EXPORT feeler-targets NAMESPACE feeler:: DESTINATION ${package_dir})
install(FILES ${CMAKE_CURRENT_LIST_DIR}/feeler-config.cmake ${PROJECT_BINARY_DIR}/feeler-config-version.cmake
  DESTINATION ${package_dir})
install(FILES ${PROJECT_BINARY_DIR}/feeler.pc DESTINATION ${CMAKE_INSTALL_DATADIR}/pkgconfig)
