// The one exception of the demo: input that it cannot use.
#pragma once

#include <stdexcept>
#include <string>

namespace feeler::demo {

/// What is wrong and what to do about it, in one sentence; the program prints it and ends with exit code 2.
class BadInput : public std::runtime_error {
 public:
  explicit BadInput(const std::string& sentence) : std::runtime_error(with_full_stop(sentence)) {}

 private:
  // The library's refusals leave it out.
  static std::string with_full_stop(const std::string& sentence) { return sentence.empty() || sentence.back() == '.' ? sentence : sentence + '.'; }
};

}  // namespace feeler::demo
