#include "study/player_of.hpp"

namespace feeler::study {
namespace {
const Registration registration({"float", "float", "dual active set", "default", make_convex_player<float>});
}  // namespace
}  // namespace feeler::study
