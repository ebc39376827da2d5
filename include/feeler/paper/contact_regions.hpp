// Where the tool meets the object, as the paper's method follows it.
#pragma once

#include <algorithm>
#include <limits>

#include "feeler/core/fixed_vector.hpp"
#include "feeler/core/index.hpp"
#include "feeler/paper/first_contacts.hpp"
#include "feeler/paper/triangle_ring.hpp"
#include "feeler/proximity/separation.hpp"
#include "feeler/proximity/sweep.hpp"
#include "feeler/render/rendered_scene.hpp"

namespace feeler {

/// The regions of contact, a first contact each: how collision detection finds them, and which triangles they move to with the tool
/// (paper, section IV, step 2.1).
/// @tparam capacity  regions followed at once
template <ConvexTool ToolType, int capacity>
class ContactRegions {
 public:
  using Scene = RenderedScene<ToolType>;
  using Scalar = typename Scene::Scalar;
  using MeshScalar = typename Scene::MeshScalar;
  using Tool = typename Scene::Tool;
  using Contact = FirstContact<Scalar>;

  int size() const noexcept { return regions_.size(); }
  bool empty() const noexcept { return regions_.empty(); }
  const Contact& operator[](int i) const noexcept { return regions_[i]; }
  void clear() noexcept { regions_.clear(); }

  /// Each region follows the nearest triangle of its neighbourhood.
  /// @param work  grows by the triangles looked at
  void track(const Scene& scene, const Pose<Scalar>& pose, int& work) noexcept {
    const Pose<Scalar> frame = scene.tool_frame(pose);
    for (Contact& region : regions_) {
      const auto neighbourhood = ring(scene, region.triangle);
      work += neighbourhood.size();
      separation_from_nearest(scene, neighbourhood, frame, region);
    }
    for (int i = regions_.size() - 1; i > 0; --i) {
      for (int j = 0; j < i; ++j) {
        if (regions_[i].triangle != regions_[j].triangle) continue;
        regions_.swap_remove(i);
        break;
      }
    }
  }

  /// Tracks vertices out of free space; in contact, takes up regions overlapped at the haptic pose that are not yet followed.
  /// @param reach    regions farther away than that are left alone [m]
  /// @param dropped  grows by the lists and regions that there was no room for, here and below
  void find(const Scene& scene, const Pose<Scalar>& pose, const Pose<Scalar>& target, Scalar reach, int& dropped) noexcept {
    const Pose<Scalar> from = scene.tool_frame(pose), to = scene.tool_frame(target);
    if (regions_.empty()) {
      const Contact hit = first_vertex_hit(scene.tool(), scene.object(), from, to);
      if (hit.triangle >= 0) regions_.push_back(hit);
      if (regions_.empty()) return;
    }
    OverlappedTriangles overlapped = overlapped_triangles(scene.tool(), scene.object(), to, scene.clearance().touching);
    if (!overlapped.is_complete) ++dropped;
    auto& left = overlapped.triangles;
    for (const Contact& region : regions_) {
      const auto neighbourhood = ring(scene, region.triangle);
      for (int i = left.size() - 1; i >= 0; --i) {
        if (contains(neighbourhood, left[i])) left.swap_remove(i);
      }
    }
    while (!left.empty()) {
      Contact first;
      const Scalar separation = separation_from_nearest(scene, remove_connected(scene, left, left[0]), from, first);
      if (separation < reach && !regions_.push_back(first)) ++dropped;
    }
  }

  /// Blockers near no region become regions; false when there were none.
  bool admit(const Scene& scene, const Pose<Scalar>& pose, const SweepResult<Scalar>& result, int& dropped) noexcept {
    const Pose<Scalar> frame = scene.tool_frame(pose);
    bool is_new = false;
    for (const auto& blocker : result.blockers) {
      const bool is_known = std::any_of(regions_.begin(), regions_.end(),
                                        [&](const Contact& region) { return contains(ring(scene, region.triangle), blocker.triangle); });
      if (is_known) continue;
      Contact contact;
      separation_from(scene, blocker.triangle, frame, contact);
      if (!regions_.push_back(contact)) ++dropped;
      is_new = true;
    }
    return is_new;
  }

  /// The regions that hold the tool or touch it are the first contacts of the next tick.
  /// @param active  the constraints that hold the tool; their regions are numbered anew
  template <class ActiveList>
  void keep_in_contact(const Scene& scene, const Pose<Scalar>& pose, ActiveList& active) noexcept {
    const Pose<Scalar> frame = scene.tool_frame(pose);
    for (int i = regions_.size() - 1; i >= 0; --i) {
      if (std::any_of(active.begin(), active.end(), [i](const auto& holding) { return holding.region == i; })) continue;
      Contact contact;
      if (separation_from(scene, regions_[i].triangle, frame, contact) < scene.margin()) continue;
      regions_.swap_remove(i);
      for (auto& holding : active) {
        if (holding.region == regions_.size()) holding.region = i;
      }
    }
  }

 private:
  using TriangleList = FixedVector<int, OverlappedTriangles::capacity>;

  static auto ring(const Scene& scene, int triangle) noexcept { return TriangleRing<Scalar, MeshScalar>::around(scene.object(), triangle); }
  template <class Triangles>
  static bool contains(const Triangles& triangles, int triangle) noexcept {
    return std::find(triangles.begin(), triangles.end(), triangle) != triangles.end();
  }

  /// Of some triangles, as below, the least separation and the contact there; infinity, and the contact as it was, where there is none.
  template <class Triangles>
  static Scalar separation_from_nearest(const Scene& scene, const Triangles& triangles, const Pose<Scalar>& frame, Contact& nearest) noexcept {
    Scalar least = std::numeric_limits<Scalar>::infinity();
    for (const int triangle : triangles) {
      Contact contact;
      const Scalar separation = separation_from(scene, triangle, frame, contact);
      if (!(separation < least)) continue;
      least = separation;
      nearest = contact;
    }
    return least;
  }
  /// Separation of a triangle [m], and the contact it makes: between the tool vertices that are lowest over it and the triangle.
  static Scalar separation_from(const Scene& scene, int triangle, const Pose<Scalar>& frame, Contact& contact) noexcept {
    const Matrix3<Scalar> corners = scene.object().corners(triangle).template cast<Scalar>();
    const Matrix3<Scalar> in_tool = frame.rotation.toRotationMatrix().transpose() * (corners.colwise() - frame.translation);
    auto closest = gjk(scene.tool(), in_tool, {}, scene.clearance().touching);
    if (closest.is_touching) closest = separation_of_touching(scene.tool(), in_tool, closest);
    const Vector3<Scalar>& normal = closest.normal;
    const Scalar lowest = normal.dot(scene.tool().vertex(scene.tool().support(Vector3<Scalar>(-normal))));
    contact = {triangle, frame.rotation * normal, {}};
    auto& features = contact.features;
    for (int i = 0; i < scene.tool().vertex_count() && features.size < 3; ++i) {
      if (normal.dot(scene.tool().vertex(i)) > lowest + 2 * scene.margin()) continue;
      features.tool_vertices[as_index(features.size)] = short(i);
      features.corners[as_index(features.size)] = short(features.size);
      ++features.size;
    }
    return closest.distance;
  }

  /// Takes a triangle and all that are joined to it out of a list, and returns them.
  static TriangleList remove_connected(const Scene& scene, TriangleList& list, int seed) noexcept {
    TriangleList group;
    const auto take = [&](int triangle) {
      for (int i = 0; i < list.size(); ++i) {
        if (list[i] != triangle) continue;
        list.swap_remove(i);
        group.push_back(triangle);
        return;
      }
    };
    take(seed);
    for (int i = 0; i < group.size(); ++i) {
      for (int k = 0; k < 3; ++k) take(scene.object().topology().neighbour(group[i], k));
    }
    return group;
  }

  FixedVector<Contact, capacity> regions_;
};

}  // namespace feeler
