// How the programs of this folder take the time of a tick, and what they say of many.
#pragma once

#include <algorithm>
#include <cstddef>
#include <ctime>
#include <vector>

namespace feeler::bench {

/// Processor time of this thread [µs]: other programs on the machine do not count.
inline double thread_time() noexcept {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return double(t.tv_sec) * 1e6 + double(t.tv_nsec) * 1e-3;
}

/// The value below which a share of the values lies; 0 of none.
inline double quantile(std::vector<double> values, double share) {
  if (values.empty()) return 0.0;
  std::sort(values.begin(), values.end());
  return values[std::size_t(share * double(values.size() - 1))];
}

}  // namespace feeler::bench
