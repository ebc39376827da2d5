#include "feeler/paper/candidate_contacts.hpp"
#include "study/player_of.hpp"

namespace feeler::study {
namespace {
constexpr CandidateOptions options{.local_solution = LocalSolution::free,
                                   .collision_detection = CollisionDetection::certificate,
                                   .increments = Increments::rotation_vector,
                                   .linearisations = 4};
const Registration registration({"paper_corrected", "double", "dual active set", "paper, every correction",
                                 make_convex_player<double, DualActiveSet<double>, CandidateContacts<options>>});
}  // namespace
}  // namespace feeler::study
