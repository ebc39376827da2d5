// The library after <windows.h>, whose macros are `near`, `far`, `interface`, `ERROR` and others; mingw's has no `min` in C++. Without
// Boost.Test, which includes it in a way of its own.
#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <Eigen/QR>

#include <windows.h>
#if !defined(near) || !defined(far) || !defined(ERROR) || !defined(interface)
#error "windows.h has none of its macros here, and this test sees nothing"
#endif

#include <feeler/device/wrench_guard.hpp>
#include <feeler/feeler.hpp>

/// Whether a box that is pressed on a floor stays on it and feels it.
bool renders_after_windows_headers() {
  feeler::Points<double> vertices(3, 3);
  vertices << -1, -1, 0, 1, -1, 0, 0, 1, 0;
  feeler::Triangles triangles(1, 3);
  triangles << 0, 1, 2;
  const feeler::TriangleMesh<double> object(vertices, triangles);
  feeler::HapticRenderer renderer(object, feeler::Box<double>({0.01, 0.01, 0.01}));
  if (renderer.reset({.translation = {0, 0, 0.02}}) != feeler::Status::converged) return false;
  const auto& tick = renderer.update({.translation = {0, 0, 0.005}});
  return tick.wrench.force.z() > 4.9 && tick.graphic_pose.translation.z() > 0.01;
}
