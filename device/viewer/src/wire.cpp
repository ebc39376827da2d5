// Writes the numbers that page/protocol.js reads.
#include "feeler/viewer/wire.hpp"

#include <bit>
#include <cstdint>
#include <cstring>

namespace feeler::viewer {
namespace {

static_assert(std::endian::native == std::endian::little, "pages read little-endian numbers");

/// Appends numbers as doubles.
class Words {
 public:
  explicit Words(WireKind kind) {
    add(wire_version);
    add(static_cast<int>(kind));
  }

  template <class Number>
  void add(Number value) {
    words_.push_back(double(value));
  }
  template <class List>
  void add_all(const List& list) {
    for (const auto& value : list) add(value);
  }
  void add(const DevicePose& pose) {
    add_all(pose.position);
    add_all(pose.orientation);
  }
  void add(const DeviceWrench& wrench) {
    add_all(wrench.force);
    add_all(wrench.torque);
  }
  void add(const ShownContact& contact) {
    add(contact.type);
    add_all(contact.point);
    add_all(contact.normal);
    add(contact.gap);
    add(contact.force);
  }
  void add(const TickSample& sample) {
    add(sample.time);
    add(sample.wrench);
    add(sample.offset);
    add(sample.turn);
    add(sample.compute_microseconds);
    add(sample.late_microseconds);
    add(sample.contacts);
    add(sample.iterations);
    add(sample.missed);
    add((sample.has_converged ? 1 : 0) + (sample.has_folded ? 2 : 0));
  }

  std::string bytes() const { return bytes_of(words_); }
  std::string bytes_as_floats() const { return bytes_of(std::vector<float>(words_.begin(), words_.end())); }

 private:
  template <class Number>
  static std::string bytes_of(const std::vector<Number>& numbers) {
    return {reinterpret_cast<const char*>(numbers.data()), numbers.size() * sizeof(Number)};
  }

  std::vector<double> words_;
};

void append(std::string& bytes, const void* data, std::size_t size) { bytes.append(static_cast<const char*>(data), size); }

Words words_of(const Frame& frame) {
  const Snapshot& snapshot = frame.snapshot;
  Words words(WireKind::frame);
  words.add(snapshot.stage);
  words.add(snapshot.tick);
  words.add(snapshot.time);
  words.add(static_cast<int>(snapshot.mode));
  words.add(snapshot.haptic);
  words.add(snapshot.graphic);
  words.add(snapshot.wrench);
  words.add(snapshot.status);
  words.add(snapshot.iterations);
  words.add(snapshot.rows);
  words.add(snapshot.work);
  words.add(snapshot.missed);
  words.add(frame.lost);
  words.add(snapshot.contact_count + std::int64_t(frame.recognised.size()));
  words.add(frame.samples.size());
  for (int i = 0; i < snapshot.contact_count; ++i) words.add(snapshot.contacts[std::size_t(i)]);
  for (const ShownContact& contact : frame.recognised) words.add(contact);
  for (const TickSample& sample : frame.samples) words.add(sample);
  return words;
}

}  // namespace

std::string encoded(const Frame& frame) { return words_of(frame).bytes(); }
std::string encoded_as_floats(const Frame& frame) { return words_of(frame).bytes_as_floats(); }

std::string encoded_mesh(int stage, const Points<double>& vertices, const Triangles& triangles) {
  const Vector3<double> centre = vertices.rows() == 0
                                     ? Vector3<double>::Zero()
                                     : Vector3<double>((vertices.colwise().minCoeff() + vertices.colwise().maxCoeff()).transpose() / 2);
  Words words(WireKind::mesh);
  words.add(stage);
  words.add_all(centre);
  words.add(vertices.rows());
  words.add(triangles.rows());
  std::string bytes = words.bytes();
  using RowMajorFloats = Eigen::Matrix<float, Eigen::Dynamic, 3, Eigen::RowMajor>;
  using RowMajorIndices = Eigen::Matrix<std::int32_t, Eigen::Dynamic, 3, Eigen::RowMajor>;
  const RowMajorFloats points = (vertices.rowwise() - centre.transpose()).cast<float>();
  const RowMajorIndices indices = triangles;
  append(bytes, points.data(), std::size_t(points.size()) * sizeof(float));
  append(bytes, indices.data(), std::size_t(indices.size()) * sizeof(std::int32_t));
  return bytes;
}

}  // namespace feeler::viewer
