// A renderer of any scalar, QP solver and contact method behind one face, so that the study compiles each in a file of its own.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "feeler/core/status.hpp"
#include "study/cell.hpp"
#include "study/scenes.hpp"

namespace feeler::study {

using Wide = long double;

/// What a tick gave.
struct Reading {
  Pose<Wide> pose;
  Vector3<Wide> force, torque;  ///< [N], [N·m]
  TickStatus status = TickStatus::not_reset;
  int work = 0;
  bool is_at_rest = false;  ///< the tool did not move
  double microseconds = 0;  ///< processor time of the tick alone
  long operations = 0;      ///< on numbers, where the scalar counts them
};

/// A renderer at work.
class Player {
 public:
  virtual ~Player() = default;
  virtual TickStatus reset(const Pose<double>& pose) = 0;
  virtual Reading update(const Pose<double>& hand) = 0;
};

/// A combination of scalar, QP solver and contact method that is compiled in.
struct Rendering {
  std::string name, scalar, solver, method;
  /// @throws std::invalid_argument  where the renderer refuses the scene
  std::function<std::unique_ptr<Player>(const StudyScene&, const Cell&)> make;
};

/// Those of the files that are linked, in the order of their names; `double` first.
const std::vector<Rendering>& renderings();
/// @throws std::invalid_argument  for one that is not compiled in
const Rendering& rendering(const std::string& name);

/// Adds one before `main`.
struct Registration {
  explicit Registration(Rendering rendering);
};

}  // namespace feeler::study
