// Stands in for CHAI3D 3.3 where docs/examples/chai3d_tool.hpp is tested: the public names that it uses, and what they do.
#pragma once

#include <chrono>
#include <memory>
#include <vector>

#include <Eigen/Core>

namespace chai3d {

class cVector3d : public Eigen::Vector3d {
 public:
  cVector3d() : Eigen::Vector3d(0, 0, 0) {}
  cVector3d(double x, double y, double z) : Eigen::Vector3d(x, y, z) {}
  cVector3d(const Eigen::Vector3d& vector) : Eigen::Vector3d(vector) {}
  double length() const { return norm(); }
  Eigen::Vector3d eigen() { return *this; }
};

class cMatrix3d : public Eigen::Matrix3d {
 public:
  cMatrix3d() : Eigen::Matrix3d(Identity()) {}
  Eigen::Matrix3d eigen() { return *this; }
  cVector3d operator*(const cVector3d& vector) const { return cVector3d(static_cast<const Eigen::Matrix3d&>(*this) * vector); }
};
inline cVector3d operator+(const cVector3d& a, const cVector3d& b) { return cVector3d(a[0] + b[0], a[1] + b[1], a[2] + b[2]); }

class cWorld {};

class cGenericObject {
 public:
  void setLocalPos(const cVector3d& position) { position_ = position; }
  cVector3d getGlobalPos() const { return position_; }
  cMatrix3d getGlobalRot() const { return {}; }

 private:
  cVector3d position_;
};

struct cVertexArray {
  std::vector<cVector3d> positions;
  cVector3d getLocalPos(unsigned int i) const { return positions[i]; }
};

struct cTriangleArray {
  std::vector<unsigned int> indices;
  unsigned int getVertexIndex0(unsigned int i) const { return indices[3 * i]; }
  unsigned int getVertexIndex1(unsigned int i) const { return indices[3 * i + 1]; }
  unsigned int getVertexIndex2(unsigned int i) const { return indices[3 * i + 2]; }
};

class cMesh : public cGenericObject {
 public:
  std::shared_ptr<cVertexArray> m_vertices = std::make_shared<cVertexArray>();
  std::shared_ptr<cTriangleArray> m_triangles = std::make_shared<cTriangleArray>();
  unsigned int getNumVertices() const { return unsigned(m_vertices->positions.size()); }
  unsigned int getNumTriangles() const { return unsigned(m_triangles->indices.size() / 3); }
};

struct cHapticDeviceInfo {
  double m_maxLinearForce = 0, m_maxAngularTorque = 0;
  double m_maxLinearStiffness = 0, m_maxAngularStiffness = 0;
  double m_maxLinearDamping = 0;
  bool m_actuatedRotation = false;
};

class cGenericHapticDevice {
 public:
  virtual ~cGenericHapticDevice() = default;
  cHapticDeviceInfo getSpecifications() { return m_specifications; }
  virtual bool getPosition(cVector3d& position) = 0;
  virtual bool setForceAndTorqueAndGripperForce(const cVector3d& force, const cVector3d& torque, double gripper) = 0;

 protected:
  cHapticDeviceInfo m_specifications;
};
using cGenericHapticDevicePtr = std::shared_ptr<cGenericHapticDevice>;

struct cPrecisionClock {
  static inline double seconds = 0;  // moved by the test
  static double getCPUTimeSeconds() { return seconds; }
};

class cGenericTool : public cGenericObject {
 public:
  explicit cGenericTool(cWorld*) {}
  virtual ~cGenericTool() = default;
  void setHapticDevice(cGenericHapticDevicePtr device) { m_hapticDevice = device; }
  bool setWorkspaceScaleFactor(const double& factor) { return m_workspaceScaleFactor = factor, true; }
  void setUseForceRise(bool value) { m_useForceRise = value; }
  bool start() { return initialize(), true; }
  virtual void initialize() = 0;
  virtual void updateFromDevice() {
    const Eigen::Vector3d before = m_deviceGlobalPos;
    m_hapticDevice->getPosition(m_deviceGlobalPos);
    m_deviceGlobalPos = cVector3d(m_workspaceScaleFactor * m_deviceGlobalPos);
    velocity_ = cVector3d(1000 * (m_deviceGlobalPos - before));
  }
  virtual void computeInteractionForces() = 0;
  virtual void updateToolImagePosition() = 0;
  void setDeviceGlobalForce(const cVector3d& force) { force_ = force; }
  void setDeviceGlobalTorque(const cVector3d& torque) { torque_ = torque; }
  void setGripperForce(const double& force) { gripper_ = force; }
  virtual bool applyToDevice() {
    // While forces rise it damps, after whoever limits them.
    const double damping = 0.2 * m_hapticDevice->getSpecifications().m_maxLinearDamping;
    return m_hapticDevice->setForceAndTorqueAndGripperForce(m_useForceRise ? cVector3d(force_ - damping * velocity_) : force_, torque_, gripper_);
  }

 protected:
  cGenericHapticDevicePtr m_hapticDevice;
  std::unique_ptr<cGenericObject> m_image = std::make_unique<cGenericObject>();
  cVector3d m_deviceGlobalPos;
  cMatrix3d m_deviceGlobalRot;
  unsigned int m_userSwitches = 0;
  double m_workspaceScaleFactor = 1;
  bool m_useForceRise = false;

 private:
  cVector3d force_, torque_, velocity_;
  double gripper_ = 0;
};

}  // namespace chai3d
