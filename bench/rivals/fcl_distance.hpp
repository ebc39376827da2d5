// The exact distance of tool and object by the Flexible Collision Library: one query, no rendering.
#pragma once

#include <memory>

#include "feeler/spatial/pose.hpp"
#include "rivals/coupled_scene.hpp"

namespace feeler::rivals {

/// Triangles of all pieces of the tool against the triangles of the object, each in a hierarchy of rectangle
/// swept spheres.
class FclDistance {
 public:
  explicit FclDistance(const CoupledScene& scene);
  FclDistance(FclDistance&&) noexcept;
  FclDistance& operator=(FclDistance&&) noexcept;
  ~FclDistance();

  /// Distance at a pose [m]; not positive where the library says that they touch.
  double operator()(const Pose<double>& pose) const;

 private:
  struct Models;
  std::unique_ptr<Models> models_;
};

}  // namespace feeler::rivals
