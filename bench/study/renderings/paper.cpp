#include "feeler/paper/candidate_contacts.hpp"
#include "study/player_of.hpp"

namespace feeler::study {
namespace {
const Registration registration({"paper", "double", "dual active set", "paper as written",
                                 make_convex_player<double, DualActiveSet<double>, CandidateContacts<>>});
}  // namespace
}  // namespace feeler::study
