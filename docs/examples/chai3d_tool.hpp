// A tool for CHAI3D 3.3 that Feeler renders, and that cannot push more than its device may. Add it to the world, then `start()` it.
#pragma once
#include <chai3d.h>
#include <feeler/device/conversion.hpp>
#include <feeler/device/wrench_guard.hpp>
#include <feeler/feeler.hpp>

inline feeler::TriangleMesh<double> feeler_mesh(chai3d::cMesh& mesh) {  // as it stands in the world
  feeler::Points<double> vertices(mesh.getNumVertices(), 3);
  for (int i = 0; i < vertices.rows(); ++i)
    vertices.row(i) = (mesh.getGlobalPos() + mesh.getGlobalRot() * mesh.m_vertices->getLocalPos(unsigned(i))).eigen().transpose();
  feeler::Triangles triangles(mesh.getNumTriangles(), 3);
  for (int i = 0; i < triangles.rows(); ++i)
    triangles.row(i) << int(mesh.m_triangles->getVertexIndex0(unsigned(i))), int(mesh.m_triangles->getVertexIndex1(unsigned(i))),
        int(mesh.m_triangles->getVertexIndex2(unsigned(i)));
  return {vertices, triangles};
}
inline feeler::DeviceSpecification specification_of(const chai3d::cHapticDeviceInfo& info) {
  feeler::DeviceSpecification device;
  device.maximum_force = info.m_maxLinearForce;
  device.continuous_force = info.m_maxLinearForce / 4;
  if (info.m_actuatedRotation) device.maximum_torque = info.m_maxAngularTorque, device.continuous_torque = info.m_maxAngularTorque / 4;
  device.is_pushed = {true, true, true, info.m_actuatedRotation, info.m_actuatedRotation, info.m_actuatedRotation};
  return device;
}
template <class Tool>
class FeelerTool : public chai3d::cGenericTool {
 public:
  FeelerTool(chai3d::cWorld* world, chai3d::cGenericHapticDevicePtr device, const feeler::TriangleMesh<double>& object, const Tool& tool,
             double scale)
      : cGenericTool(world),
        renderer_(object, tool, settings_of(device->getSpecifications(), scale)),
        guard_(specification_of(device->getSpecifications()), 1000) {
    setHapticDevice(device);
    setWorkspaceScaleFactor(scale);
  }
  void initialize() override { updateFromDevice(), feeler::nearest_free_pose(renderer_, hand()); }  // no force where none is found
  void computeInteractionForces() override {
    const auto& tick = renderer_.update(hand());
    const double now = chai3d::cPrecisionClock::getCPUTimeSeconds();
    const auto pushed = guard_.allowed({feeler::to_device_pose(hand()), m_userSwitches, now}, feeler::to_device_wrench(tick.wrench), now);
    setDeviceGlobalForce({pushed.force[0], pushed.force[1], pushed.force[2]});
    setDeviceGlobalTorque({pushed.torque[0], pushed.torque[1], pushed.torque[2]});
    setGripperForce(0);
  }
  bool applyToDevice() override { return m_useForceRise = false, cGenericTool::applyToDevice(); }  // its rise adds forces that nobody limits
  void updateToolImagePosition() override { m_image->setLocalPos(chai3d::cVector3d(renderer_.tick().graphic_pose.translation)); }
  const auto& renderer() const { return renderer_; }

 private:
  static feeler::Settings<double> settings_of(const chai3d::cHapticDeviceInfo& info, double scale) {
    return {.stiffness = feeler::Stiffness<double>::uniform(info.m_maxLinearStiffness / scale,
                                                            info.m_maxAngularStiffness > 0 ? info.m_maxAngularStiffness : 0.3)};
  }
  feeler::Pose<double> hand() { return {m_deviceGlobalPos.eigen(), feeler::Quaternion<double>(m_deviceGlobalRot.eigen())}; }
  feeler::HapticRenderer<Tool> renderer_;
  feeler::WrenchGuard guard_;
};
