// Catches a refusal.
#include "feeler/tool/box.hpp"

bool is_refused();
bool is_refused() try { return feeler::Box<double>({-1, 1, 1}).vertex_count() == 0; } catch (const std::invalid_argument&) {
  return true;
}
