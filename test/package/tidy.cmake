# Fails, and says where, if clang-tidy finds something in the headers. usage: cmake -DCLANG_TIDY=program -DSOURCE_DIR=tree -DSOURCE=file.cpp "-DINCLUDES=-I…" -P tidy.cmake
file(WRITE ${SOURCE} "#include <feeler/feeler.hpp>\n")
execute_process(COMMAND ${CLANG_TIDY} --quiet --config-file=${SOURCE_DIR}/.clang-tidy --warnings-as-errors=* ${SOURCE} -- -std=c++20 ${INCLUDES}
  RESULT_VARIABLE result OUTPUT_VARIABLE complaints ERROR_VARIABLE problems)
if(NOT result EQUAL 0)
  message(FATAL_ERROR "${complaints}${problems}")
endif()
