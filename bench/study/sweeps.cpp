#include "study/sweeps.hpp"

#include <algorithm>
#include <cstdlib>
#include <initializer_list>
#include <map>
#include <set>
#include <sstream>
#include <stdexcept>
#include <tuple>
#include <utility>

#include "study/player.hpp"
#include "study/scenes.hpp"

namespace feeler::study {
namespace {

bool is_among(const std::vector<std::string>& list, const std::string& name) {
  return list.empty() || std::find(list.begin(), list.end(), name) != list.end();
}

void check_names(const char* what, const std::vector<std::string>& asked, const std::vector<std::string>& known) {
  for (const auto& name : asked) {
    if (std::find(known.begin(), known.end(), name) != known.end()) continue;
    std::string text = std::string("There is no ") + what + " " + name + "; there are:";
    for (const auto& other : known) text += " " + other;
    throw std::invalid_argument(text + ".");
  }
}

/// What is a number of a cell, by its name in the key.
std::map<std::string, double> numbers_of(const Cell& cell) {
  return {{"margin", cell.margin},     {"budget", double(cell.budget)}, {"iterations", double(cell.iterations)},
          {"rate", double(cell.rate)}, {"scale", cell.scale},           {"offset", cell.offset}};
}

/// Values that are asked for, by name.
using Values = std::map<std::string, std::set<double>>;

/// Adds "margin=1e-6,1e-5".
void read_only(const std::string& text, Values& only) {
  const auto equals = std::min(text.find('='), text.size());
  const std::string name = text.substr(0, equals);
  std::set<double> values;
  std::stringstream list(text.substr(std::min(equals + 1, text.size())));
  bool is_list = numbers_of({}).contains(name);
  for (std::string value; std::getline(list, value, ',');) {
    char* end = nullptr;
    values.insert(std::strtod(value.c_str(), &end));
    is_list = is_list && !value.empty() && *end == '\0';
  }
  if (is_list && !values.empty()) return only[name].merge(values);
  std::string names;
  for (const auto& [known, value] : numbers_of({})) names += " " + known;
  throw std::invalid_argument("--only is " + text + "; give values of one of these, such as margin=1e-6,1e-5:" + names + ".");
}

void check_cells(const std::vector<Cell>& cells, const Values& only) {
  if (cells.empty()) throw std::invalid_argument("These filters leave no cell; --list shows what there is.");
  Values left;
  for (const Cell& cell : cells)
    for (const auto& [name, value] : numbers_of(cell)) left[name].insert(value);
  for (const auto& [name, values] : only)
    for (const double value : values)
      if (std::ostringstream text; !left[name].contains(value)) {
        text << "These filters leave no cell with the " << name << " " << value << "; --list shows what there is.";
        throw std::invalid_argument(text.str());
      }
}

template <class Value>
std::vector<Value> some(bool is_quick, std::initializer_list<Value> all, std::initializer_list<Value> few) {
  return is_quick ? few : all;
}

/// Scenes that are moved away and scaled: one of each kind.
const std::vector<std::string> small_scenes{"bore_24", "plate_2", "wedge_4"};

template <class Named>
std::vector<std::string> names_of(const std::vector<Named>& list) {
  std::vector<std::string> names;
  for (const auto& one : list) names.push_back(one.name);
  return names;
}

/// @return the values that are asked for
Values read(const Selection& selection) {
  check_names("sweep", selection.sweeps, names_of(sweeps()));
  check_names("scene", selection.scenes, scene_names());
  for (const auto& name : selection.renderings) rendering(name);
  check_names("motion", selection.motions, names_of(motions()));
  Values only;
  for (const auto& text : selection.only) read_only(text, only);
  return only;
}

}  // namespace

const std::vector<Sweep>& sweeps() {
  static const std::vector<Sweep> list{
      {"renderings", "what do scalar, QP solver and contact method change?"},
      {"margin", "what does the margin cost?"},
      {"budget", "what does a unit of work buy?"},
      {"iterations", "what does a linearisation buy?"},
      {"rate", "what does the rate change?"},
      {"motion", "what does a slow, a quick or a trembling hand change?"},
      {"offset", "how far from the origin does a scalar reach?"},
      {"scale", "for which sizes do the defaults hold?"},
      {"front", "which settings are both faster and more exact?"},
  };
  return list;
}

std::vector<Cell> cells_of(const Selection& selection) {
  const Values only = read(selection);
  const std::vector<std::string> known_renderings = names_of(renderings());
  const bool quick = selection.is_quick;
  const std::vector<std::string> quick_scenes{"cavity_1mm", "spline_20um", "sulcus", "terrain_968", "bore_24", "wedge_4"};
  std::vector<Cell> cells;
  std::set<std::string> known;
  const auto add = [&](const Cell& cell) {
    if (!is_among(selection.scenes, cell.scene) || !is_among(selection.renderings, cell.rendering)) return;
    if (!is_among(selection.motions, cell.motion)) return;
    if (quick && selection.scenes.empty() && !is_among(quick_scenes, cell.scene) && !is_among(small_scenes, cell.scene)) return;
    if (cell.rendering != "double" && has_several_pieces(cell.scene)) return;
    if (!is_among(known_renderings, cell.rendering)) return;
    for (const auto& [name, values] : only)
      if (!values.contains(numbers_of(cell).at(name))) return;
    if (known.insert(cell.key()).second) cells.push_back(cell);
  };
  const auto vary = [&](const std::vector<std::string>& scenes, const auto& values, const auto& change) {
    for (const auto& scene : scenes)
      for (const auto& value : values) {
        Cell cell{.scene = scene};
        change(cell, value);
        add(cell);
      }
  };
  const auto scenes = scene_names();
  const std::vector<std::string> scalars{"float", "double", "long_double", "quad"};
  for (const auto& sweep : sweeps()) {
    if (!is_among(selection.sweeps, sweep.name)) continue;
    if (sweep.name == "renderings") vary(scenes, known_renderings, [](Cell& cell, const std::string& name) { cell.rendering = name; });
    if (sweep.name == "margin")
      vary(scenes, some<double>(quick, {1e-8, 1e-7, 1e-6, 1e-5, 1e-4}, {1e-7, 1e-6, 1e-5}), [](Cell& cell, double value) { cell.margin = value; });
    for (const std::string rendering : {"double", "counted"}) {
      if (sweep.name == "budget")
        vary(scenes, some(quick, {16, 32, 64, 128, 256, 512, 2048}, {32, 128, 512}),
             [&](Cell& cell, int value) { cell.rendering = rendering, cell.budget = value; });
      if (sweep.name == "iterations")
        vary(scenes, some(quick, {1, 2, 3, 4, 6, 12, 32}, {1, 4, 12}),
             [&](Cell& cell, int value) { cell.rendering = rendering, cell.iterations = value; });
    }
    if (sweep.name == "rate")
      vary(scenes, some(quick, {250, 500, 1000, 2000, 4000, 10000}, {500, 1000, 4000}), [](Cell& cell, int value) { cell.rate = value; });
    if (sweep.name == "motion")
      vary(scenes, quick ? std::vector<std::string>{"usual", "quick"} : names_of(motions()),
           [](Cell& cell, const std::string& name) { cell.motion = name; });
    for (const auto& scalar : scalars) {
      if (sweep.name == "offset")
        vary(small_scenes, some<double>(quick, {0, 1, 10, 1e2, 1e3, 1e4, 1e5, 1e6}, {0, 1, 1e3}),
             [&](Cell& cell, double value) { cell.rendering = scalar, cell.offset = value; });
      if (sweep.name == "scale")
        vary(small_scenes, some<double>(quick, {1e-3, 1e-2, 1e-1, 1, 10, 100, 1e3}, {0.1, 1, 10}),
             [&](Cell& cell, double value) { cell.rendering = scalar, cell.scale = value; });
    }
    if (sweep.name == "front" && !quick)
      for (const auto& scene : scenes)
        for (const double margin : {1e-7, 1e-6, 1e-5})
          for (const int budget : {32, 64, 128, 256})
            for (const int iterations : {2, 4, 12}) add({.scene = scene, .margin = margin, .budget = budget, .iterations = iterations});
  }
  check_cells(cells, only);
  return cells;
}

std::vector<int> groups_of(const std::vector<Cell>& cells) {
  std::map<std::tuple<std::string, std::string, double, double, double>, int> known;
  std::vector<int> groups;
  for (const Cell& cell : cells)
    groups.push_back(known.emplace(std::tuple(cell.scene, cell.motion, cell.scale, cell.offset, cell.margin), int(known.size())).first->second);
  return groups;
}

}  // namespace feeler::study
