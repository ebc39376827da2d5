// The numbers behind the picture of a run: object, ways of the tool's tip, and both tools.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

#include "recording.hpp"
#include "scenes/scene.hpp"

namespace feeler::demo {

/// Writes run_object.dat (triangles as pairs of lines, with their brightness) and run.dat (way of the haptic
/// and the graphic tip; edges of the haptic tool; edges of the graphic tool, both at the peak force), all in
/// millimetres.
class RunFigureData {
 public:
  /// Where the picture is looked at from [degrees], as gnuplot's `set view`.
  static constexpr double tilt = 52.0, turn = 28.0;

  RunFigureData(const std::filesystem::path& folder, const scenes::Scene& scene,
                const std::vector<TickRecord>& ticks);

  const Eigen::AlignedBox3d& box() const { return box_; }  ///< of all that is drawn [mm]
  std::size_t drawn_triangles() const { return drawn_; }

 private:
  void write_object(const std::filesystem::path& file);
  void write_ways_and_tools(const std::filesystem::path& file);

  const scenes::Scene& scene_;
  const std::vector<TickRecord>& ticks_;
  Eigen::AlignedBox3d box_;
  std::size_t drawn_ = 0;
};

}  // namespace feeler::demo
