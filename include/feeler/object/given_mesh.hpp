// The vertices and triangles that a user gives, as matrices or arrays, and what is wrong with them.
#pragma once

#include <cstddef>
#include <limits>
#include <string>
#include <utility>

#include "feeler/core/scalar.hpp"

namespace feeler::detail {

/// Three numbers a row, one row after the other, as most engines keep vertices and indices; a view, not a copy.
template <class Number>
Eigen::Map<const Eigen::Matrix<Number, Eigen::Dynamic, 3, Eigen::RowMajor>> rows_of_three(const Number* numbers, std::size_t count) {
  return {numbers, Eigen::Index(count), 3};
}

/// What is wrong with the numbers of vertices and triangles, or nothing.
inline std::string reason_against_counts(const std::string& who, std::size_t vertex_count, std::size_t triangle_count) {
  constexpr std::size_t most = std::size_t((std::numeric_limits<int>::max)()) / 3;  // edges have numbers too
  if (vertex_count <= most && triangle_count <= most) return {};
  return who + ": " + std::to_string(vertex_count) + " vertices and " + std::to_string(triangle_count) + " triangles, and there may be " +
         std::to_string(most) + " of each; give the numbers of rows, not less than 0, or split the object";
}

/// What is wrong with arrays of three numbers a row, or nothing.
inline std::string reason_against_arrays(const std::string& who, const void* vertices, std::size_t vertex_count, const void* triangles,
                                         std::size_t triangle_count) {
  if ((vertex_count > 0 && vertices == nullptr) || (triangle_count > 0 && triangles == nullptr))
    return who + ": the pointer to the vertices or the triangles is null; give the first number of each array";
  return reason_against_counts(who, vertex_count, triangle_count);
}

/// What is wrong with vertices in a unit of so many metres, and triangles over them, or nothing.
/// @param part  which of several it is, as the end of a name
template <class Scalar, class VertexRows, class IndexRows>
std::string reason_against_mesh(const std::string& who, const std::string& part, const VertexRows& vertices, const IndexRows& triangles,
                                Scalar scale) {
  if (!(scale > Scalar(0) && scale <= (std::numeric_limits<Scalar>::max)()))
    return who + ": the scale is not a positive number; give metres a unit, as 0.001 for millimetres";
  for (Eigen::Index i = 0; i < vertices.rows(); ++i) {
    if ((vertices.row(i).template cast<Scalar>() * scale).allFinite()) continue;
    const auto& given = vertices.row(i).array();
    return who + ": vertex " + std::to_string(i) + part +
           ((given - given == 0).all() ? " is too far away for the scalar of the mesh; give metres, and a scale that makes metres of other units"
                                       : " has a NaN or an infinity; correct its coordinates or remove it and its triangles");
  }
  for (Eigen::Index i = 0; i < triangles.rows(); ++i)
    for (int k = 0; k < 3; ++k)
      if (std::cmp_less(+triangles(i, k), 0) || std::cmp_greater_equal(+triangles(i, k), vertices.rows()))  // of a char the number
        return who + ": triangle " + std::to_string(i) + part + " has the index " + std::to_string(triangles(i, k)) + ", but " +
               (part.empty() ? "there are " : "the part has ") + std::to_string(vertices.rows()) + " vertices; indices start at 0" +
               (part.empty() ? "" : " in each part") + " and must be less than that";
  return {};
}

}  // namespace feeler::detail
