// The one exception of the demo: input that it cannot use.
#pragma once

#include <stdexcept>

namespace feeler::demo {

/// What is wrong and what to do about it, in one sentence; the program prints it and ends with exit code 2.
class BadInput : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace feeler::demo
