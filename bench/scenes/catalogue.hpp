// The scenes that programs measure, by the names that their options and tables use.
#pragma once

#include <filesystem>
#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "scenes/cavity.hpp"
#include "scenes/spline.hpp"
#include "scenes/steps.hpp"
#include "scenes/sulcus.hpp"
#include "scenes/terrain.hpp"

namespace feeler::scenes {

/// A scene that can be made.
struct CatalogueEntry {
  std::string family;  ///< one word: cavity, steps, spline, sulcus, terrain
  std::string label;   ///< one row of a table
  double clearance = std::numeric_limits<double>::infinity();  ///< least free play of the tool [m]; infinite
                                                               ///< where nothing fits
  std::function<std::variant<Scene, CompoundScene>()> make;
};

/// The scenes without a file, in the order of tables. Nothing is made before it is asked for.
inline std::vector<CatalogueEntry> catalogue() {
  std::vector<CatalogueEntry> list;
  constexpr double none = std::numeric_limits<double>::infinity();
  const auto add = [&](const char* family, std::string label, double clearance, auto make) {
    list.push_back({family, std::move(label), clearance, [make] { return std::variant<Scene, CompoundScene>(make()); }});
  };
  for (const auto& [clearance, label] : {std::pair(1e-3, "cavity 1 mm"), std::pair(1e-5, "cavity 10 µm"), std::pair(0.0, "cavity none")}) {
    add("cavity", label, clearance, [clearance = clearance] { return cavity(clearance); });
  }
  add("steps", "steps line", none, steps);
  add("steps", "steps prism", none, steps_with_prism);
  for (const auto& [clearance, label] : {std::pair(2e-4, "spline 200 µm"), std::pair(2e-5, "spline 20 µm"), std::pair(0.0, "spline none")}) {
    add("spline", label, clearance, [clearance = clearance] { return spline(clearance); });
  }
  add("sulcus", "sulcus", none, sulcus);
  for (const int cells : {22, 71, 224, 707}) {
    add("terrain", "terrain " + std::to_string(2 * cells * cells), none, [cells] { return terrain(cells); });
  }
  return list;
}

}  // namespace feeler::scenes
