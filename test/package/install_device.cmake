# Builds and installs the device module without tests, benchmarks, demo and scenes, then moves the result.
file(REMOVE_RECURSE ${PREFIX} ${PREFIX}-before)
execute_process(COMMAND ${CMAKE_COMMAND} -S ${SOURCE} -B ${BINARY_DIR} -G ${GENERATOR} -DCMAKE_CXX_COMPILER=${COMPILER} -DCMAKE_BUILD_TYPE=Debug
  -DFEELER_BUILD_TESTS=OFF -DFEELER_BUILD_BENCH=OFF -DFEELER_BUILD_DEMO=OFF COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --build ${BINARY_DIR} --target help OUTPUT_VARIABLE targets COMMAND_ERROR_IS_FATAL ANY)
foreach(unwanted scene demo)
  if(targets MATCHES "feeler-${unwanted}")
    message(FATAL_ERROR "The device module alone has a target of the ${unwanted}: ${targets}")
  endif()
endforeach()
execute_process(COMMAND ${CMAKE_COMMAND} --build ${BINARY_DIR} COMMAND_ERROR_IS_FATAL ANY)
execute_process(COMMAND ${CMAKE_COMMAND} --install ${BINARY_DIR} --prefix ${PREFIX}-before COMMAND_ERROR_IS_FATAL ANY)
file(RENAME ${PREFIX}-before ${PREFIX})
