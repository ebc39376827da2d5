#include "study/player_of.hpp"
#include "support/multiprecision.hpp"

namespace feeler::study {
namespace {
const Registration registration({"quad", "quad", "dual active set", "default", make_convex_player<feeler_test::Quad>});
}  // namespace
}  // namespace feeler::study
