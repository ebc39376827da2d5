// The coupling of a device to Bullet.
#include "rivals/bullet_tool.hpp"

#include <algorithm>

#include <btBulletDynamicsCommon.h>

#include "rivals/spring_coupling.hpp"

#ifndef BT_USE_DOUBLE_PRECISION
#error "Feeler is compared in double precision: define BT_USE_DOUBLE_PRECISION and link a Bullet that was built with it."
#endif

namespace feeler::rivals {
namespace {

/// How Bullet is set; lengths in metres of the scene, not of Bullet's world.
struct BulletSettings {
  std::string name;
  int substeps;
  double scale;   ///< units of Bullet's world in a metre
  double margin;  ///< around the tool [m]
  double erp, contact_erp;
  int iterations;
  SpringCoupling coupling;
};

class BulletTool final : public CoupledTool {
 public:
  BulletTool(const CoupledScene& scene, BulletSettings settings, double tick_seconds)
      : settings_(std::move(settings)),
        tick_seconds_(tick_seconds),
        dispatcher_(&configuration_),
        world_(&dispatcher_, &broadphase_, &solver_, &configuration_) {
    const auto& setting = scene.setting;
    for (Eigen::Index i = 0; i < setting.vertices.rows(); ++i) {
      const btVector3 v = scaled(setting.vertices.row(i).transpose());
      vertices_.insert(vertices_.end(), {v.x(), v.y(), v.z()});
    }
    for (Eigen::Index i = 0; i < setting.triangles.rows(); ++i) {
      for (int k = 0; k < 3; ++k) indices_.push_back(setting.triangles(i, k));
    }
    triangles_ = std::make_unique<btTriangleIndexVertexArray>(int(indices_.size() / 3), indices_.data(), int(3 * sizeof(int)),
                                                              int(vertices_.size() / 3), vertices_.data(), int(3 * sizeof(btScalar)));
    object_shape_ = std::make_unique<btBvhTriangleMeshShape>(triangles_.get(), true);
    object_shape_->setMargin(0.0);
    object_ = std::make_unique<btRigidBody>(btRigidBody::btRigidBodyConstructionInfo(0.0, nullptr, object_shape_.get()));
    make_frictionless(*object_);
    world_.addRigidBody(object_.get());

    for (const auto& points : scene.pieces) {
      auto hull = std::make_unique<btConvexHullShape>();
      for (Eigen::Index i = 0; i < points.rows(); ++i) hull->addPoint(scaled(points.row(i).transpose()), false);
      hull->recalcLocalAabb();
      hull->setMargin(settings_.margin * settings_.scale);
      hulls_.push_back(std::move(hull));
    }
    btCollisionShape* shape = hulls_.front().get();
    if (hulls_.size() > 1) {
      for (const auto& hull : hulls_) compound_.addChildShape(btTransform::getIdentity(), hull.get());
      compound_.setMargin(settings_.margin * settings_.scale);
      shape = &compound_;
    }
    const double inertia = settings_.coupling.inertia * settings_.scale * settings_.scale;
    body_ = std::make_unique<btRigidBody>(
        btRigidBody::btRigidBodyConstructionInfo(settings_.coupling.mass, nullptr, shape, btVector3(inertia, inertia, inertia)));
    body_->setActivationState(DISABLE_DEACTIVATION);
    make_frictionless(*body_);
    world_.addRigidBody(body_.get());

    world_.setGravity(btVector3(0.0, 0.0, 0.0));
    body_->setGravity(btVector3(0.0, 0.0, 0.0));
    auto& solver = world_.getSolverInfo();
    solver.m_erp = settings_.erp;
    solver.m_erp2 = settings_.contact_erp;
    solver.m_numIterations = settings_.iterations;
    reset(setting.start);
  }
  ~BulletTool() override {
    world_.removeRigidBody(body_.get());
    world_.removeRigidBody(object_.get());
  }

  const std::string& name() const override { return settings_.name; }

  void reset(const Pose<double>& pose) override {
    const auto& q = pose.rotation;
    const btTransform transform(btQuaternion(q.x(), q.y(), q.z(), q.w()), scaled(pose.translation));
    // Bodies leave and come back, so that nothing is left of contacts and of the order in which they were
    // found.
    world_.removeRigidBody(body_.get());
    world_.removeRigidBody(object_.get());
    broadphase_.resetPool(&dispatcher_);
    solver_.reset();
    const btVector3 zero(0.0, 0.0, 0.0);
    body_->setCenterOfMassTransform(transform);
    body_->setLinearVelocity(zero);
    body_->setAngularVelocity(zero);
    body_->setInterpolationLinearVelocity(zero);
    body_->setInterpolationAngularVelocity(zero);
    body_->clearForces();
    world_.addRigidBody(object_.get());
    world_.addRigidBody(body_.get());
    device_.reset(pose);
  }

  CoupledTick update(const Pose<double>& haptic_pose) override {
    device_.advance(haptic_pose, tick_seconds_);
    path_.clear();
    const double step = tick_seconds_ / settings_.substeps;
    for (int i = 0; i < settings_.substeps; ++i) {
      // With the velocity fed forward, the spring acts on where the device is as the step begins: a body at
      // the device's velocity has no lag.
      pull_towards(settings_.coupling.feeds_velocity_forward ? device_.pose(double(i) / settings_.substeps) : haptic_pose);
      world_.stepSimulation(step, 0, step);
      path_.push_back(pose());
    }
    const Pose<double>& body = path_.back();
    return {body, settings_.coupling.spring_on_hand(body, haptic_pose), settings_.coupling.damper_on_hand(velocity(), device_.velocity()), path_};
  }

 private:
  static void make_frictionless(btRigidBody& body) {
    body.setFriction(0.0);
    body.setRestitution(0.0);
    body.setDamping(0.0, 0.0);
  }
  btVector3 scaled(const Vector3<double>& v) const { return {v.x() * settings_.scale, v.y() * settings_.scale, v.z() * settings_.scale}; }
  static Vector3<double> vector(const btVector3& v) { return {v.x(), v.y(), v.z()}; }
  Pose<double> pose() const {
    const btTransform& transform = body_->getWorldTransform();
    const btQuaternion q = transform.getRotation();
    return {vector(transform.getOrigin()) / settings_.scale, Quaternion<double>(q.w(), q.x(), q.y(), q.z()).normalized()};
  }
  Twist<double> velocity() const { return {vector(body_->getLinearVelocity()) / settings_.scale, vector(body_->getAngularVelocity())}; }

  void pull_towards(const Pose<double>& haptic) {
    const auto spring = settings_.coupling.spring_on_hand(pose(), haptic);
    const auto damper = settings_.coupling.damper_on_hand(velocity(), device_.velocity());
    body_->applyCentralForce(-scaled(spring.force + damper.force));
    body_->applyTorque(-scaled(spring.torque + damper.torque) * settings_.scale);
  }

  BulletSettings settings_;
  double tick_seconds_;
  DeviceMotion device_;
  std::vector<Pose<double>> path_;
  std::vector<btScalar> vertices_;
  std::vector<int> indices_;
  std::unique_ptr<btTriangleIndexVertexArray> triangles_;
  std::unique_ptr<btBvhTriangleMeshShape> object_shape_;
  std::vector<std::unique_ptr<btConvexHullShape>> hulls_;
  btCompoundShape compound_;
  std::unique_ptr<btRigidBody> object_, body_;
  btDefaultCollisionConfiguration configuration_;
  btCollisionDispatcher dispatcher_;
  btDbvtBroadphase broadphase_;
  btSequentialImpulseConstraintSolver solver_;
  btDiscreteDynamicsWorld world_;
};

}  // namespace

std::unique_ptr<CoupledTool> make_bullet_tool(const CoupledScene& scene, int substeps, double tick_seconds) {
  const double margin = std::clamp(scene.clearance / 8.0, 1e-6, 1e-4);
  return std::make_unique<BulletTool>(scene,
                                      BulletSettings{"Bullet ×" + std::to_string(substeps), substeps, 100.0, margin, 0.8, 0.8, 10,
                                                     SpringCoupling::of_stiffness(scene.setting.stiffness())},
                                      tick_seconds);
}

std::unique_ptr<CoupledTool> make_chai3d_tool(const CoupledScene& scene, double tick_seconds) {
  constexpr double scale = 30.0, mass = 0.01;
  const double length = scene.setting.length;
  const SpringCoupling coupling{.stiffness = 4000.0,
                                .rotational_stiffness = 30.0 / (scale * scale),
                                .mass = mass,
                                .inertia = mass * length * length,
                                .feeds_velocity_forward = false};
  return std::make_unique<BulletTool>(scene, BulletSettings{"Bullet as CHAI3D", 1, scale, 33e-6, 0.2, 0.2, 10, coupling}, tick_seconds);
}

}  // namespace feeler::rivals
