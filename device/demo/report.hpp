// The folder of a run: all that somebody needs to judge it with a program of their own.
#pragma once

#include <filesystem>
#include <string>

#include "options.hpp"
#include "recording.hpp"
#include "scene_choice.hpp"
#include "session.hpp"
#include "summary.hpp"

namespace feeler::demo {

/// A folder that appears when it is complete: files go to a sibling that is renamed at the end, or removed.
class ReportFolder {
 public:
  /// @throws BadInput when the folder cannot be made, or exists and is no report that may be replaced
  explicit ReportFolder(const std::filesystem::path& target);
  ~ReportFolder();
  ReportFolder(const ReportFolder&) = delete;
  ReportFolder& operator=(const ReportFolder&) = delete;

  const std::filesystem::path& partial() const { return partial_; }  ///< where to write
  const std::filesystem::path& target() const { return target_; }
  void publish();  ///< takes the place of an older report

 private:
  std::filesystem::path target_;
  std::filesystem::path partial_;
  std::filesystem::path created_parent_;  // the topmost folder made on the way; empty if none was
};

/// One run with everything that led to it.
struct Run {
  const ChosenScene& chosen;
  const SessionSettings& session;
  const Recording& recording;
  const Summary& summary;
};

/// Writes object.off, tool.off, ticks.csv, path.csv, scene.json, replay.json, the figures and report.html.
/// @return false where no figures could be drawn
bool write_report(const std::filesystem::path& folder, const Run& run);

}  // namespace feeler::demo
