// Of a user's library, built on Feeler's headers.
#pragma once
#include <feeler/feeler.hpp>

inline double margin_of_parent() { return feeler::Settings<double>{}.margin; }
