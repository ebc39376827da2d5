// What goes to a page in binary: frames of a live scene and meshes, as numbers in the byte order of the
// machine, which browsers share.
#pragma once

#include <string>
#include <vector>

#include "feeler/core/scalar.hpp"
#include "feeler/viewer/live_state.hpp"

namespace feeler::viewer {

/// Of the first word of every message; a page that does not know it says so. page/protocol.js reads what is
/// written here.
inline constexpr int wire_version = 1;
enum class WireKind { frame = 1, mesh = 2 };

/// One picture and the samples since the last one.
struct Frame {
  Snapshot snapshot;
  std::vector<ShownContact> recognised;  ///< by their types
  std::vector<TickSample> samples;
  std::int64_t lost = 0;  ///< samples that never reached the watcher
};

/// Doubles throughout: a head, then the contacts, then the samples.
std::string encoded(const Frame& frame);

/// The same numbers as floats, for recordings.
std::string encoded_as_floats(const Frame& frame);

/// A head of doubles, then vertices as floats about their own centre, which is in the head, then triangles as
/// 32-bit integers.
std::string encoded_mesh(int stage, const Points<double>& vertices, const Triangles& triangles);

}  // namespace feeler::viewer
