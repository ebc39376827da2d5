// The coupling of a device to the Open Dynamics Engine.
#include "rivals/ode_tool.hpp"

#include <array>
#include <cstdarg>
#include <stdexcept>

#include <ode/ode.h>

#include "rivals/spring_coupling.hpp"
#include "scenes/rotation_between.hpp"

#ifndef dDOUBLE
#error "Feeler is compared in double precision: install an ODE that was built with it."
#endif

namespace feeler::rivals {
namespace {

/// The engine, initialised once for the program.
void start_ode() {
  static const struct Engine {
    Engine() {
      if (dInitODE2(0) == 0 || dAllocateODEDataForThread(unsigned(dAllocateMaskAll)) == 0) {
        throw std::runtime_error("ODE cannot be initialised.");
      }
      dSetMessageHandler([](int, const char*, va_list) {});  // it prints in the tick where contacts overflow a table
    }
    ~Engine() { dCloseODE(); }
  } engine;
}

/// Triangles in the arrays that the engine refers to.
class Trimesh {
 public:
  Trimesh() : data_(dGeomTriMeshDataCreate()) {}
  Trimesh(const Trimesh&) = delete;
  Trimesh& operator=(const Trimesh&) = delete;
  ~Trimesh() { dGeomTriMeshDataDestroy(data_); }

  void add_vertex(const Vector3<double>& v) { vertices_.insert(vertices_.end(), {v.x(), v.y(), v.z()}); }
  void add_triangle(const Eigen::Vector3i& t) {
    for (int k = 0; k < 3; ++k) indices_.push_back(dTriIndex(t[k]));
  }
  /// A shape that the caller destroys before this is destroyed.
  dGeomID build() {
    dGeomTriMeshDataBuildDouble(data_, vertices_.data(), 3 * sizeof(double), int(vertices_.size() / 3), indices_.data(), int(indices_.size()),
                                3 * sizeof(dTriIndex));
    return dCreateTriMesh(nullptr, data_, nullptr, nullptr, nullptr);
  }

 private:
  dTriMeshDataID data_;
  std::vector<double> vertices_;
  std::vector<dTriIndex> indices_;
};

class OdeTool final : public CoupledTool {
 public:
  OdeTool(const CoupledScene& scene, int substeps, double tick_seconds)
      : name_("ODE ×" + std::to_string(substeps)),
        coupling_(SpringCoupling::of_stiffness(scene.setting.stiffness())),
        substeps_(substeps),
        tick_seconds_(tick_seconds) {
    world_ = dWorldCreate();
    dWorldSetERP(world_, 0.2);
    dWorldSetQuickStepNumIterations(world_, 20);
    body_ = dBodyCreate(world_);
    dMass mass;
    dMassSetParameters(&mass, coupling_.mass, 0.0, 0.0, 0.0, coupling_.inertia, coupling_.inertia, coupling_.inertia, 0.0, 0.0, 0.0);
    dBodySetMass(body_, &mass);
    contact_joints_ = dJointGroupCreate(0);

    tool_ = make_tool(scene);
    const auto& setting = scene.setting;
    for (Eigen::Index i = 0; i < setting.vertices.rows(); ++i) object_mesh_.add_vertex(setting.vertices.row(i).transpose());
    for (Eigen::Index i = 0; i < setting.triangles.rows(); ++i) object_mesh_.add_triangle(setting.triangles.row(i).transpose());
    object_ = object_mesh_.build();
    reset(setting.start);
  }
  ~OdeTool() override {
    dGeomDestroy(tool_);
    dGeomDestroy(object_);
    dJointGroupDestroy(contact_joints_);
    dWorldDestroy(world_);
  }

  const std::string& name() const override { return name_; }

  void reset(const Pose<double>& pose) override {
    const auto& p = pose.translation;
    const auto& q = pose.rotation;
    const dQuaternion rotation{q.w(), q.x(), q.y(), q.z()};
    dBodySetPosition(body_, p.x(), p.y(), p.z());
    dBodySetQuaternion(body_, rotation);
    dBodySetLinearVel(body_, 0.0, 0.0, 0.0);
    dBodySetAngularVel(body_, 0.0, 0.0, 0.0);
    device_.reset(pose);
    random_seed_ = 0;
  }

  CoupledTick update(const Pose<double>& haptic_pose) override {
    dRandSetSeed(random_seed_);  // the engine shuffles constraints; each tool has its own stream
    device_.advance(haptic_pose, tick_seconds_);
    path_.clear();
    for (int i = 0; i < substeps_; ++i) {
      pull_towards(device_.pose(double(i) / substeps_));
      collide();
      dWorldQuickStep(world_, tick_seconds_ / substeps_);
      dJointGroupEmpty(contact_joints_);
      path_.push_back(pose());
    }
    random_seed_ = dRandGetSeed();
    const Pose<double>& body = path_.back();
    return {body, coupling_.spring_on_hand(body, haptic_pose), coupling_.damper_on_hand(velocity(), device_.velocity()), path_};
  }

 private:
  /// A box, a capsule for a line, and a trimesh for everything else.
  dGeomID make_tool(const CoupledScene& scene) {
    if (const auto* box = std::get_if<Box<double>>(&scene.primitive)) {
      const Vector3<double> sides = 2.0 * box->half_extents();
      const dGeomID geom = dCreateBox(nullptr, sides.x(), sides.y(), sides.z());
      dGeomSetBody(geom, body_);
      return geom;
    }
    if (const auto* line = std::get_if<Segment<double>>(&scene.primitive)) {
      const Vector3<double> along = line->vertex(1) - line->vertex(0), middle = (line->vertex(0) + line->vertex(1)) / 2.0;
      const auto turn = scenes::rotation_between(Vector3<double>::UnitZ(), along);
      const dQuaternion rotation{turn.w(), turn.x(), turn.y(), turn.z()};
      const dGeomID geom = dCreateCapsule(nullptr, line_radius, along.norm());
      dGeomSetBody(geom, body_);
      dGeomSetOffsetPosition(geom, middle.x(), middle.y(), middle.z());
      dGeomSetOffsetQuaternion(geom, rotation);
      return geom;
    }
    for (const auto& v : scene.tool_surface.vertices) tool_mesh_.add_vertex(v);
    for (const auto& t : scene.tool_surface.triangles) tool_mesh_.add_triangle(t);
    const dGeomID geom = tool_mesh_.build();
    dGeomSetBody(geom, body_);
    return geom;
  }

  static Vector3<double> vector(const dReal* v) { return {v[0], v[1], v[2]}; }
  Pose<double> pose() const {
    const dReal* q = dBodyGetQuaternion(body_);
    return {vector(dBodyGetPosition(body_)), Quaternion<double>(q[0], q[1], q[2], q[3])};
  }
  Twist<double> velocity() const { return {vector(dBodyGetLinearVel(body_)), vector(dBodyGetAngularVel(body_))}; }

  /// The spring acts on where the device is as the step begins, so that a body at the device's velocity has
  /// no lag.
  void pull_towards(const Pose<double>& haptic) {
    const auto spring = coupling_.spring_on_hand(pose(), haptic);
    const auto damper = coupling_.damper_on_hand(velocity(), device_.velocity());
    const Vector3<double> force = -(spring.force + damper.force), torque = -(spring.torque + damper.torque);
    dBodyAddForce(body_, force.x(), force.y(), force.z());
    dBodyAddTorque(body_, torque.x(), torque.y(), torque.z());
  }

  void collide() {
    const int count = dCollide(tool_, object_, int(contacts_.size()), contacts_.data(), sizeof(dContactGeom));
    for (int i = 0; i < count; ++i) {
      dContact contact{};  // no friction, no bounce
      contact.geom = contacts_[std::size_t(i)];
      dJointAttach(dJointCreateContact(world_, contact_joints_, &contact), dGeomGetBody(contact.geom.g1), dGeomGetBody(contact.geom.g2));
    }
  }

  std::string name_;
  SpringCoupling coupling_;
  int substeps_;
  double tick_seconds_;
  DeviceMotion device_;
  std::vector<Pose<double>> path_;
  unsigned long random_seed_ = 0;
  dWorldID world_;
  dBodyID body_;
  dJointGroupID contact_joints_;
  Trimesh tool_mesh_, object_mesh_;
  dGeomID tool_, object_;
  std::array<dContactGeom, 256> contacts_;
};

}  // namespace

std::unique_ptr<CoupledTool> make_ode_tool(const CoupledScene& scene, int substeps, double tick_seconds) {
  start_ode();
  return std::make_unique<OdeTool>(scene, substeps, tick_seconds);
}

}  // namespace feeler::rivals
