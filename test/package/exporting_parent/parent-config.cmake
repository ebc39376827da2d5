include(CMakeFindDependencyMacro)
find_dependency(feeler)
include(${CMAKE_CURRENT_LIST_DIR}/parent-targets.cmake)
