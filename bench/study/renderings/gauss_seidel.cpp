#include "feeler/qp/reference/projected_gauss_seidel.hpp"
#include "study/player_of.hpp"

namespace feeler::study {
namespace {
const Registration registration({"gauss_seidel", "double", "projected Gauss-Seidel", "default",
                                 make_convex_player<double, ProjectedGaussSeidel<double>>});
}  // namespace
}  // namespace feeler::study
