// The one exception of the demo: input that it cannot use; and what others come to.
#pragma once

#include <exception>
#include <new>
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

/// What a user should read of a problem. Words of other libraries say neither what is wrong nor what to do.
inline std::string sentence_of(const std::exception& problem) {
  if (dynamic_cast<const BadInput*>(&problem) != nullptr) return problem.what();
  if (dynamic_cast<const std::invalid_argument*>(&problem) != nullptr) return BadInput(problem.what()).what();  // of this library
  if (dynamic_cast<const std::bad_alloc*>(&problem) != nullptr) return "There is too little memory for this: choose a mesh of fewer triangles.";
  return "This cannot be built: choose another scene, or export the mesh again.";
}

}  // namespace feeler::demo
