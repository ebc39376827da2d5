# Nothing of what a program does not choose is in it: PROGRAM uses the default renderer alone, although feeler.hpp brings the rest.
execute_process(COMMAND ${NM} -C ${PROGRAM} OUTPUT_VARIABLE symbols RESULT_VARIABLE failed)
if(failed)
  message(FATAL_ERROR "${NM} cannot list the symbols of ${PROGRAM}")
endif()
if(NOT symbols MATCHES "HapticRenderer|ClosestFeaturesFollower")
  message(FATAL_ERROR "${PROGRAM} has no symbols to look at")
endif()
foreach(unused CandidateContacts LocalSearch StepCoordinates first_vertex_hit overlapped_triangles ContactRecogniser
    SurfaceFeatures WitnessSearch SphereSwept SweptContactRow)
  if(symbols MATCHES "${unused}")
    message(FATAL_ERROR "${unused} is in a program that does not use it")
  endif()
endforeach()
