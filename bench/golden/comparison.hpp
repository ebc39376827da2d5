// Says of each scene whether its trajectories are those of a file.
#pragma once

#include <cstdio>
#include <filesystem>
#include <string>

#include "golden/arithmetic.hpp"
#include "golden/record.hpp"
#include "golden/trajectory.hpp"

namespace feeler::bench {

/// Prints a line for each scene that is added, and for each of the file that is not.
class GoldenComparison {
 public:
  /// @throws std::runtime_error  as `read_golden_record`
  explicit GoldenComparison(const std::filesystem::path& file) : file_(file.string()), left_(read_golden_record(file)) {}

  /// False, and says so, if the file is of another arithmetic than this program's, in which the trajectories cannot be the same.
  bool is_possible() const {
    const auto here = arithmetic();
    if (here == left_.arithmetic) return true;
    std::printf(
        "skipped: last bits of sin, cos, tan, atan2, exp or x y + z differ here from those of %s (arithmetic %s, not %s), and so do trajectories\n",
        file_.c_str(), hexadecimal(here).c_str(), hexadecimal(left_.arithmetic).c_str());
    return false;
  }

  void add(const std::string& scene, const GoldenHashes& hashes) {
    const auto entry = left_.scenes.find(scene);
    const bool is_known = entry != left_.scenes.end(), is_same = is_known && hashes == entry->second;
    if (is_same) {
      std::printf("%s: the same\n", scene.c_str());
    } else if (!is_known) {
      std::printf("%s: is not in %s\n", scene.c_str(), file_.c_str());
    } else {
      std::printf("%s: another trajectory than in %s at", scene.c_str(), file_.c_str());
      for (std::size_t i = 0; i < hashes.size(); ++i) {
        if (hashes[i] != entry->second[i]) std::printf(" [%s]", golden_hands[i].name);
      }
      std::printf("\n");
    }
    std::fflush(stdout);
    if (is_known) left_.scenes.erase(entry);
    if (!is_same) ++others_;
  }

  /// A scene that cannot be made here.
  void skip(const std::string& scene) { left_.scenes.erase(scene); }

  /// After all scenes: those of the file that were neither added nor skipped differ too.
  void conclude_all() {
    for (const auto& [scene, hashes] : left_.scenes) {
      ++others_;
      std::printf("%s: is in %s alone\n", scene.c_str(), file_.c_str());
    }
  }

  /// Scenes that differ so far.
  int others() const { return others_; }

 private:
  std::string file_;
  GoldenRecord left_;  // of which nothing was said yet
  int others_ = 0;
};

}  // namespace feeler::bench
