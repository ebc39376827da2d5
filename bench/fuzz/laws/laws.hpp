// The laws of the nearest pose, each over scenes and hands made at random.
#pragma once

#include <string>

namespace feeler::laws {

/// Runs a law, or "all" of them, and prints a line for each and two for each run that breaks it.
/// @param first   seed of the first trial; the next ones count on
/// @return broken runs
int run_laws(const std::string& law, unsigned first, int trials);

}  // namespace feeler::laws
