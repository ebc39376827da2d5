#include "feeler/qp/reference/textbook_active_set.hpp"
#include "study/player_of.hpp"

namespace feeler::study {
namespace {
const Registration registration({"textbook", "double", "textbook active set", "default", make_convex_player<double, TextbookActiveSet<double>>});
}  // namespace
}  // namespace feeler::study
