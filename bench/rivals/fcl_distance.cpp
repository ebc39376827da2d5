// The distance query of the Flexible Collision Library.
#include "rivals/fcl_distance.hpp"

#include <fcl/geometry/bvh/BVH_model.h>
#include <fcl/narrowphase/collision_object.h>
#include <fcl/narrowphase/distance.h>

namespace feeler::rivals {
namespace {

using Model = fcl::BVHModel<fcl::RSSd>;

}  // namespace

struct FclDistance::Models {
  Model tool, object;
};

FclDistance::FclDistance(const CoupledScene& scene) : models_(std::make_unique<Models>()) {
  const auto& surface = scene.tool_surface;
  models_->tool.beginModel(int(surface.triangles.size()), 3 * int(surface.triangles.size()));
  for (const auto& t : surface.triangles) {
    models_->tool.addTriangle(surface.vertices[std::size_t(t[0])], surface.vertices[std::size_t(t[1])], surface.vertices[std::size_t(t[2])]);
  }
  models_->tool.endModel();

  const auto& setting = scene.setting;
  models_->object.beginModel(int(setting.triangles.rows()), 3 * int(setting.triangles.rows()));
  for (Eigen::Index i = 0; i < setting.triangles.rows(); ++i) {
    const auto corner = [&](int k) -> Vector3<double> { return setting.vertices.row(setting.triangles(i, k)).transpose(); };
    models_->object.addTriangle(corner(0), corner(1), corner(2));
  }
  models_->object.endModel();
}

FclDistance::FclDistance(FclDistance&&) noexcept = default;
FclDistance& FclDistance::operator=(FclDistance&&) noexcept = default;
FclDistance::~FclDistance() = default;

double FclDistance::operator()(const Pose<double>& pose) const {
  fcl::Transform3d world_from_tool = fcl::Transform3d::Identity();
  world_from_tool.translation() = pose.translation;
  world_from_tool.linear() = pose.rotation.toRotationMatrix();
  const fcl::DistanceRequestd request;
  fcl::DistanceResultd result;
  return fcl::distance(&models_->tool, world_from_tool, &models_->object, fcl::Transform3d::Identity(), request, result);
}

}  // namespace feeler::rivals
