#include "study/player.hpp"

#include <algorithm>
#include <stdexcept>

namespace feeler::study {
namespace {
std::vector<Rendering>& registered() {
  static std::vector<Rendering> list;
  return list;
}
}  // namespace

const std::vector<Rendering>& renderings() { return registered(); }

const Rendering& rendering(const std::string& name) {
  const auto& list = registered();
  const auto found = std::find_if(list.begin(), list.end(), [&](const Rendering& r) { return r.name == name; });
  if (found != list.end()) return *found;
  std::string text = "There is no rendering " + name + "; there are:";
  for (const Rendering& known : list) text += " " + known.name;
  throw std::invalid_argument(text + ". CMake builds others in with -DFEELER_STUDY_RENDERINGS=all.");
}

Registration::Registration(Rendering rendering) {
  auto& list = registered();
  const auto comes_first = [](const Rendering& a, const Rendering& b) {
    return std::pair(a.name != "double", a.name) < std::pair(b.name != "double", b.name);
  };
  list.insert(std::upper_bound(list.begin(), list.end(), rendering, comes_first), std::move(rendering));
}

}  // namespace feeler::study
