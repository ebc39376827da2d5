# What our own targets are built with: warnings, never exported to users of the library.
add_library(feeler_development INTERFACE)
target_compile_options(feeler_development INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Wnon-virtual-dtor -Woverloaded-virtual)
option(FEELER_WARNINGS_AS_ERRORS "Stop at the first warning in our own code" OFF)
if(FEELER_WARNINGS_AS_ERRORS)
  target_compile_options(feeler_development INTERFACE -Werror)
endif()
