// The version of the library; CMake reads it from here.
#pragma once

#define FEELER_VERSION "0.1.0"
