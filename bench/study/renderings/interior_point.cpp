#include "feeler/qp/reference/interior_point.hpp"
#include "study/player_of.hpp"

namespace feeler::study {
namespace {
const Registration registration({"interior_point", "double", "interior point", "default", make_convex_player<double, InteriorPoint<double>>});
}  // namespace
}  // namespace feeler::study
