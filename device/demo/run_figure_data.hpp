// The numbers behind the picture of a run: object, ways of the tool's tip, and both tools.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <vector>

#include "recording.hpp"
#include "scenes/scene.hpp"

namespace feeler::demo {

/// What of space a picture shows, in the plane that it is looked at in [mm].
struct View {
  Vector3<double> centre;
  double width, height;
};

/// Writes run_object.dat (triangles as pairs of lines, with their brightness), run_tool.dat (the same of the
/// graphic tool at the peak force) and run.dat (way of the haptic and the graphic tip; edges of the haptic
/// and of the graphic tool at the peak force), all in millimetres.
class RunFigureData {
 public:
  /// Where the picture is looked at from [degrees], as gnuplot's `set view`.
  static constexpr double tilt = 52.0, turn = 28.0;

  RunFigureData(const std::filesystem::path& folder, const scenes::Scene& scene, const std::vector<TickRecord>& ticks);

  const Eigen::AlignedBox3d& box() const { return box_; }  ///< of all that is drawn [mm]
  const TickRecord& peak() const { return *peak_; }        ///< the tick of the largest force
  View overview() const;                                   ///< all that is drawn
  std::optional<View> close_up() const;                    ///< the tip at the peak, for a tool that has one
  std::size_t drawn_triangles() const { return drawn_; }

 private:
  void write_object(const std::filesystem::path& file);
  void write_tool(const std::filesystem::path& file);
  void write_ways_and_edges(const std::filesystem::path& file);
  void extend(const Vector3<double>& point);

  const scenes::Scene& scene_;
  const std::vector<TickRecord>& ticks_;
  std::vector<TickRecord>::const_iterator peak_;
  Eigen::AlignedBox3d box_;
  Eigen::AlignedBox3d seen_;  // the same, in axes of the eye: to the right, up, to the eye
  std::size_t drawn_ = 0;
};

}  // namespace feeler::demo
