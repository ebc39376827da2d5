// One recogniser a piece; their formations joined.
#include "live/contact_watch.hpp"

#include "feeler/recognition/contact_formation.hpp"
#include "feeler/recognition/contact_recogniser.hpp"
#include "feeler/recognition/surface_features.hpp"

namespace feeler::demo {

struct ContactWatch::Features : SurfaceFeatures<double> {
  using SurfaceFeatures<double>::SurfaceFeatures;
};

class ContactWatch::Piece {
 public:
  virtual ~Piece() = default;
  /// Appends the contacts. @return whether other features touch than before
  virtual bool recognise(const Pose<double>& pose, std::vector<viewer::ShownContact>& contacts) = 0;

 protected:
  Piece() = default;
  Piece(const Piece&) = default;
  Piece& operator=(const Piece&) = default;
};

template <class Tool>
class ContactWatch::PieceOf final : public Piece {
 public:
  PieceOf(const TriangleMesh<double>& object, const Features& features, const Tool& tool, double tolerance)
      : recogniser_(object, features, tool, tolerance) {}

  bool recognise(const Pose<double>& pose, std::vector<viewer::ShownContact>& contacts) override {
    const auto& formation = recogniser_.recognise(pose);
    for (const PrincipalContact<double>& contact : formation) {
      const auto& p = contact.point_world;
      const auto& n = contact.normal_world;
      contacts.push_back({number_of(contact.type), {p.x(), p.y(), p.z()}, {n.x(), n.y(), n.z()}, contact.gap, 0});
    }
    return tracker_.observe(formation) != nullptr;
  }

 private:
  ContactRecogniser<Tool, double> recogniser_;
  FormationTracker<double> tracker_;
};

ContactWatch::ContactWatch(std::shared_ptr<const TriangleMesh<double>> object, const LiveTool& tool, double margin)
    : object_(std::move(object)), features_(std::make_unique<Features>(*object_)) {
  for_each_piece(tool,
                 [&]<class Tool>(const Tool& piece) { pieces_.push_back(std::make_unique<PieceOf<Tool>>(*object_, *features_, piece, 2 * margin)); });
}

ContactWatch::~ContactWatch() = default;

const std::vector<viewer::ShownContact>& ContactWatch::recognise(const Pose<double>& world_from_tool) {
  contacts_.clear();
  has_switched_ = false;
  for (const auto& piece : pieces_) has_switched_ = piece->recognise(world_from_tool, contacts_) || has_switched_;
  return contacts_;
}

}  // namespace feeler::demo
