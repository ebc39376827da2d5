// The contacts of a pose by their types, for a picture; never in the servo loop.
#pragma once

#include <memory>
#include <vector>

#include "feeler/object/triangle_mesh.hpp"
#include "feeler/viewer/live_state.hpp"
#include "live/live_scene.hpp"

namespace feeler::demo {

/// Recognises the principal contacts of every piece of a tool with an object. Belongs to one thread at a
/// time.
class ContactWatch {
 public:
  /// @param object  shared, because the renderer has it too
  /// @param margin  that the renderer keeps [m]; what is within twice of it touches
  ContactWatch(std::shared_ptr<const TriangleMesh<double>> object, const LiveTool& tool, double margin);
  ~ContactWatch();
  ContactWatch(const ContactWatch&) = delete;
  ContactWatch& operator=(const ContactWatch&) = delete;

  /// Valid until the next call.
  const std::vector<viewer::ShownContact>& recognise(const Pose<double>& world_from_tool);
  /// Whether other features touch than at the call before.
  bool has_switched() const noexcept { return has_switched_; }

 private:
  struct Features;
  class Piece;
  template <class Tool>
  class PieceOf;

  std::shared_ptr<const TriangleMesh<double>> object_;
  std::unique_ptr<Features> features_;
  std::vector<std::unique_ptr<Piece>> pieces_;
  std::vector<viewer::ShownContact> contacts_;
  bool has_switched_ = false;
};

}  // namespace feeler::demo
