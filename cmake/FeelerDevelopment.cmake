# What our own targets are built with: warnings, never exported to users of the library.
add_library(feeler_development INTERFACE)
target_compile_options(feeler_development INTERFACE
  -Wall -Wextra -Wpedantic -Wconversion -Wshadow -Wdouble-promotion -Wnon-virtual-dtor -Woverloaded-virtual)
option(FEELER_WARNINGS_AS_ERRORS "Stop at the first warning in our own code" OFF)
if(FEELER_WARNINGS_AS_ERRORS)
  target_compile_options(feeler_development INTERFACE -Werror)
endif()

# For what runs for a moment in tests: with the address sanitizer it takes half the time to compile without optimisation.
function(feeler_optimise_nothing_if_sanitized target)
  if(CMAKE_CXX_FLAGS MATCHES "-fsanitize=address")
    target_compile_options(${target} PRIVATE -O0)
  endif()
endfunction()
