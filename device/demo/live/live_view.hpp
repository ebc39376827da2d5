// The live view: a servo loop that renders, and a page that shows it and moves its hand.
#pragma once

#include "options.hpp"

namespace feeler::demo {

/// Serves the page until the program is interrupted, or for `Options::view_seconds`. Prints where the page
/// is, and at the end what the servo loop says of itself.
/// @throws BadInput where the port cannot be had, the scene cannot be made, or the program was built without
/// its viewer
void run_live_view(const Options& options);

}  // namespace feeler::demo
