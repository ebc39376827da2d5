// What rounding can do in a scene, by its lengths.
#pragma once

#include <algorithm>
#include <limits>

#include "feeler/core/scalar.hpp"
#include "feeler/object/triangle_mesh.hpp"
#include "feeler/proximity/motion.hpp"
#include "feeler/tool/rigid_tool.hpp"
#include "feeler/tool/swept_tool.hpp"

namespace feeler {

/// The lengths of an object and a tool that decide how exact distances between them and poses near them can be.
/// @tparam MeshScalar  in which poses are returned
/// @tparam Scalar      in which distances are measured
template <RealScalar MeshScalar, RealScalar Scalar>
struct SceneRounding {
  Scalar size;      ///< of the object, or of the tool about the reference point, the larger [m]
  Scalar reach;     ///< of the tool from the origin of its frame [m]
  Scalar farthest;  ///< that the object is from the origin of the world [m]

  /// @param tool       in the scalar that decides collisions
  /// @param reference  in the tool frame [m]
  template <RigidTool Tool>
  SceneRounding(const TriangleMesh<MeshScalar>& object, const Tool& tool, const Vector3<Scalar>& reference) {
    Scalar surface = Scalar(0);
    for (int i = 0; i < piece_count(tool); ++i)
      surface = (std::max)(surface, radius_about(piece_of(tool, i), reference) + swept_radius(piece_of(tool, i)));
    size = (std::max)(surface, Scalar(object.bounds().diagonal().norm()));
    reach = surface + reference.norm();
    farthest = Vector3<Scalar>((object.bounds().min)().cwiseAbs().cwiseMax((object.bounds().max)().cwiseAbs()).template cast<Scalar>()).norm();
  }

  /// Overlap that rounding may make or hide [m].
  Scalar allowance() const noexcept { return 256 * std::numeric_limits<Scalar>::epsilon() * size; }
  /// Least margin with which rounding cannot carry a tool through a surface, or 0.1 nm [m].
  Scalar least_margin() const noexcept { return (std::max)(Scalar(1e-10), 20 * allowance()); }
  /// How far a point of the tool may be from where it should be when the tool touches the object and its pose is rounded to `MeshScalar` [m].
  Scalar of_poses() const noexcept {
    const Scalar unit = Scalar(std::numeric_limits<MeshScalar>::epsilon()) / 2;
    return unit * (farthest + reach) + 4 * unit * reach;  // a quaternion off by δ turns by 2 δ, and stretches by as much
  }
};

}  // namespace feeler
