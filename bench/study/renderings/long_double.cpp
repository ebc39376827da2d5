#include "study/player_of.hpp"

namespace feeler::study {
namespace {
const Registration registration({"long_double", "long double", "dual active set", "default", make_convex_player<long double>});
}  // namespace
}  // namespace feeler::study
