#include "feeler/paper/candidate_contacts.hpp"
#include "study/player_of.hpp"

namespace feeler::study {
namespace {
constexpr CandidateOptions options{.collision_detection = CollisionDetection::certificate};
const Registration registration({"paper_certified", "double", "dual active set", "paper, motions certified",
                                 make_convex_player<double, DualActiveSet<double>, CandidateContacts<options>>});
}  // namespace
}  // namespace feeler::study
