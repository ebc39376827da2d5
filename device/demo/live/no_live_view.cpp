// In place of the live view where the program was built without it.
#include "bad_input.hpp"
#include "live/live_view.hpp"
#include "live/replay_view.hpp"
#include "live/report_player.hpp"

namespace feeler::demo {
namespace {

[[noreturn]] void refuse_to_view() {
  throw BadInput(
      "This feeler-demo was built without its viewer: install nodejs, npm and libboost-dev, run npm ci in "
      "device/viewer, and build it again.");
}

}  // namespace

void run_live_view(const Options&) { refuse_to_view(); }
void run_replay_view(const Options&) { refuse_to_view(); }
std::optional<std::string> player_recording(const scenes::Scene&, const Recording&) { return {}; }
std::string player_page(const std::vector<std::string>&) { refuse_to_view(); }

}  // namespace feeler::demo
