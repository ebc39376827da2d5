// A program without exceptions and run-time types, as many engines are built. It uses the default renderer alone.
#include <feeler/feeler.hpp>

int main() {
  feeler::Points<double> vertices(3, 3);
  vertices << -1, -1, 0, 1, -1, 0, 0, 1, 0;
  feeler::Triangles triangles(1, 3);
  triangles << 0, 1, 2;
  const feeler::TriangleMesh<double> object(vertices, triangles);
  feeler::HapticRenderer renderer(object, feeler::Box<double>(feeler::Vector3<double>::Constant(0.01)));
  feeler::Pose<double> pose;
  pose.translation.z() = 0.02;
  if (renderer.reset(pose) != feeler::Status::converged) return 1;
  pose.translation.z() = 0.005;
  const auto& tick = renderer.update(pose);
  return tick.wrench.force.z() > 4.9 && tick.graphic_pose.translation.z() > 0.01 ? 0 : 1;
}
