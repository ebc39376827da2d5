#include "study/player_of.hpp"
#include "support/multiprecision.hpp"

namespace feeler::study {
namespace {
const Registration registration({"digits50", "50 digits", "dual active set", "default", make_convex_player<feeler_test::Float50>});
}  // namespace
}  // namespace feeler::study
