// One of two sources that include the whole library: a function that is not inline would be defined twice.
#include <feeler/feeler.hpp>

double margin_seen_by_the_other_source();

int main() { return feeler::Settings<double>{}.margin == margin_seen_by_the_other_source() ? 0 : 1; }
