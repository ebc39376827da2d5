# Writes a header with the commit of the tree, at each build; called as cmake -DSOURCE=… -DHEADER=… -P commit.cmake
execute_process(COMMAND git describe --always --dirty --abbrev=10 WORKING_DIRECTORY ${SOURCE} OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET)
if(NOT commit)
  set(commit "unknown")
endif()
file(CONFIGURE OUTPUT ${HEADER} CONTENT "// Made by cmake/commit.cmake.
#pragma once
namespace feeler::study {
inline constexpr const char* commit = \"${commit}\";
}
")
