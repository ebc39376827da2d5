# The headers, the device module where it is built, the CMake package and the pkg-config file. But for the module all of it is text, so the same files
# serve every architecture.
#
# The targets are exported even where nothing is installed: a library of the parent project that exports itself, installed or from its build tree, may
# link them, and then its package finds this one.
set(feeler_package_dir share/cmake/feeler)
set(feeler_library_dir lib)
set(feeler_exclusion COMPONENT feeler EXCLUDE_FROM_ALL)
if(FEELER_INSTALL)
  include(GNUInstallDirs)
  include(CMakePackageConfigHelpers)
  set(feeler_package_dir ${CMAKE_INSTALL_DATADIR}/cmake/feeler)
  set(feeler_library_dir ${CMAKE_INSTALL_LIBDIR})
  set(feeler_exclusion "")
endif()

install(TARGETS feeler EXPORT feeler-targets)
install(EXPORT feeler-targets NAMESPACE feeler:: DESTINATION ${feeler_package_dir} ${feeler_exclusion})
export(EXPORT feeler-targets NAMESPACE feeler:: FILE ${PROJECT_BINARY_DIR}/feeler-targets.cmake)
if(TARGET feeler_device)
  install(TARGETS feeler_device EXPORT feeler-device-targets ARCHIVE DESTINATION ${feeler_library_dir} ${feeler_exclusion})
  install(EXPORT feeler-device-targets NAMESPACE feeler:: DESTINATION ${feeler_package_dir} ${feeler_exclusion})
  export(EXPORT feeler-device-targets NAMESPACE feeler:: FILE ${PROJECT_BINARY_DIR}/feeler-device-targets.cmake)
endif()
if(NOT FEELER_INSTALL)
  return()
endif()

write_basic_package_version_file(${PROJECT_BINARY_DIR}/feeler-config-version.cmake
  COMPATIBILITY SameMinorVersion ARCH_INDEPENDENT)
configure_file(${CMAKE_CURRENT_LIST_DIR}/feeler.pc.in ${PROJECT_BINARY_DIR}/feeler.pc @ONLY)

install(DIRECTORY ${PROJECT_SOURCE_DIR}/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
if(TARGET feeler_device)
  install(DIRECTORY ${PROJECT_SOURCE_DIR}/device/include/ DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})
endif()
install(FILES ${CMAKE_CURRENT_LIST_DIR}/feeler-config.cmake ${PROJECT_BINARY_DIR}/feeler-config-version.cmake
  DESTINATION ${feeler_package_dir})
install(FILES ${PROJECT_BINARY_DIR}/feeler.pc DESTINATION ${CMAKE_INSTALL_DATADIR}/pkgconfig)
