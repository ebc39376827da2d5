// The file of golden trajectories: a line a scene, written by one run and compared with by others.
#pragma once

#include <cstdint>
#include <filesystem>
#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

#include "golden/trajectory.hpp"

namespace feeler::bench {

/// What a run found or a file holds.
struct GoldenRecord {
  std::uint64_t arithmetic = 0;                ///< see `bench::arithmetic`
  std::map<std::string, GoldenHashes> scenes;  ///< by the label of a table
};

inline std::string hexadecimal(std::uint64_t number) {
  std::ostringstream out;
  out.width(16);
  out.fill('0');
  out << std::hex << number;
  return out.str();
}

/// The head of a file.
inline std::string golden_head(std::uint64_t arithmetic) {
  std::ostringstream out;
  out << "# Written by feeler-replay --hash: a hash over pose, wrench, status and work of every tick, for "
         "three hands.\n"
      << "# They hold for this arithmetic (docs/numerics.md):\n"
      << hexadecimal(arithmetic) << " arithmetic\n#";
  for (const Hand& hand : golden_hands) {
    out << hand.name << std::string(16 - std::char_traits<char>::length(hand.name) - (&hand == golden_hands.data() ? 1 : 0), ' ') << ' ';
  }
  out << "scene\n";
  return out.str();
}

/// A line of a file.
inline std::string golden_line(const std::string& scene, const GoldenHashes& hashes) {
  std::string line;
  for (const auto hash : hashes) line += hexadecimal(hash) + ' ';
  return line + scene + '\n';
}

inline GoldenRecord read_golden_record(const std::filesystem::path& file) {
  std::ifstream in(file);
  GoldenRecord record;
  bool has_arithmetic = false;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    std::istringstream words(line);
    words >> std::hex;
    std::string label;
    GoldenHashes hashes{};
    bool is_understood = false;
    if (!has_arithmetic) {
      has_arithmetic = is_understood = words >> record.arithmetic >> label && label == "arithmetic";
    } else {
      for (auto& hash : hashes) words >> hash;
      is_understood = bool(std::getline(words >> std::ws, label));
      record.scenes[label] = hashes;
    }
    if (!is_understood)
      throw std::runtime_error(file.string() + ": cannot be read at \"" + line + "\"; write it again: feeler-replay --hash > " + file.string());
  }
  if (!has_arithmetic)
    throw std::runtime_error(file.string() + ": is not there or holds no trajectories; write it: feeler-replay --hash > " + file.string());
  return record;
}

}  // namespace feeler::bench
