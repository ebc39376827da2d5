// A double that counts its operations, for a figure that is the same on every machine.
#include "../../../docs/examples/counting_scalar.hpp"

#include "study/player_of.hpp"

namespace feeler::study {
namespace {
const Registration registration({"counted", "counted double", "dual active set", "default", make_convex_player<counting::Counted>});
}  // namespace
}  // namespace feeler::study
