# feeler-scene-renderers: the renderers of the scenes' tools, compiled once for the tests, benchmarks and the demo.
add_library(feeler-scene-renderers STATIC ${PROJECT_SOURCE_DIR}/bench/scenes/renderers.cpp)
target_include_directories(feeler-scene-renderers PUBLIC ${PROJECT_SOURCE_DIR}/bench)
target_link_libraries(feeler-scene-renderers PUBLIC feeler::feeler PRIVATE feeler_development)
if(NOT FEELER_BUILD_TESTS AND NOT FEELER_BUILD_BENCH)
  target_compile_definitions(feeler-scene-renderers PRIVATE FEELER_RENDERERS_OF_THE_DEMO_ALONE)  # a fifth less to compile
  target_compile_options(feeler-scene-renderers PRIVATE $<$<CONFIG:Release>:-O3>)  # where the ticks are; the demo around them needs no more than -O1
endif()

# feeler-round-renderers: those of round tools, for what times nothing: tests, the fuzzer, and the programs of the documentation.
add_library(feeler-round-renderers STATIC EXCLUDE_FROM_ALL ${PROJECT_SOURCE_DIR}/bench/scenes/round_renderers.cpp)
target_compile_definitions(feeler-round-renderers PRIVATE FEELER_COMPILE_QUICKLY)
target_include_directories(feeler-round-renderers PUBLIC ${PROJECT_SOURCE_DIR}/bench)
target_link_libraries(feeler-round-renderers PUBLIC feeler::feeler PRIVATE feeler_development)
