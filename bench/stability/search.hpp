// Finds how far a quantity may be raised.
#pragma once

#include <cmath>

namespace feeler::stability {

/// The largest value for which a predicate holds, to 2 %: by doubling or halving from a guess, then bisection
/// of logarithms. Values at a half and at 0.7 of what was found are tried too, and the search goes on below
/// the first that fails.
/// @param lowest   nothing below is tried: 0 where even this fails
/// @param highest  nothing above is tried: returned where all hold
template <class Predicate>
double largest_where(const Predicate& holds, double guess, double lowest, double highest) {
  double good = 0, bad = 0;
  for (double value = guess; bad == 0;) {
    if (holds(value)) {
      good = value;
      if (value >= highest) return highest;
      value = std::fmin(2 * value, highest);
    } else {
      bad = value;
    }
  }
  for (;;) {
    for (double value = bad / 2; good == 0; value /= 2) {
      if (value < lowest) return 0;
      (holds(value) ? good : bad) = value;
    }
    while (bad / good > 1.02) {
      const double middle = std::sqrt(good * bad);
      (holds(middle) ? good : bad) = middle;
    }
    bool holds_below = true;
    for (const double share : {0.7, 0.5}) {
      if (holds_below && share * good >= lowest && !holds(share * good)) {
        holds_below = false;
        bad = share * good;
      }
    }
    if (holds_below) return good;
    good = 0;
  }
}

}  // namespace feeler::stability
