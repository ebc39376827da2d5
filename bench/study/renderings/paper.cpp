#include "study/player_of.hpp"
#include "feeler/paper/candidate_contacts.hpp"

namespace feeler::study {
namespace {
const Registration registration({"paper", "double", "dual active set", "paper as written", make_convex_player<double, DualActiveSet<double>, CandidateContacts<>>});
}  // namespace
}  // namespace feeler::study
