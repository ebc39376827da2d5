#include <feeler/feeler.hpp>

double margin_seen_by_the_other_source() { return feeler::Settings<double>{}.margin; }
