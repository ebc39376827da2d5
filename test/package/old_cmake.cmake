# What users' CMake reads has no command, option or variable that is younger than 3.16: no such CMake is here to run it.
set(files CMakeLists.txt device/CMakeLists.txt cmake/FeelerInstall.cmake cmake/feeler-config.cmake cmake/FeelerDevelopment.cmake)
set(younger "cmake_path" "PROJECT_IS_TOP_LEVEL" "file\\(CONFIGURE" "file\\(CREATE_LINK" "cmake_language" "COMMAND_ERROR_IS_FATAL" "ARCHIVE_CREATE"
  "block\\(" "IN ZIP_LISTS" "FILE_SET" "add_custom_command\\([^)]*DEPFILE" "string\\(JSON" "CMAKE_CURRENT_FUNCTION" "REQUIRED_FOUND" "PATH_EQUAL" "TARGET_RUNTIME_DLLS"
  "return\\(PROPAGATE" "GENEX_STRIP" "SYSTEM[ )]*EXCLUDE_FROM_ALL" "find_package\\([^)]*GLOBAL" "LINK_LIBRARY:" "DEVICE_LINK" "include_guard\\(PROPAGATE")
foreach(file IN LISTS files)
  file(READ ${SOURCE}/${file} text)
  string(REGEX REPLACE "#[^\n]*" "" text "${text}")
  foreach(word IN LISTS younger)
    if(text MATCHES "${word}")
      message(SEND_ERROR "${file} has ${CMAKE_MATCH_0}, which CMake 3.16 does not know")
    endif()
  endforeach()
endforeach()
file(READ ${SOURCE}/CMakeLists.txt text)
if(NOT text MATCHES "cmake_minimum_required\\(VERSION 3\\.16\\.\\.\\.")
  message(SEND_ERROR "CMakeLists.txt asks for another version than 3.16")
endif()
