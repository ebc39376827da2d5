// The lengths by which the features of a contact patch are judged.
#pragma once

namespace feeler {

/// All follow from the height of the band above the separating plane in which features count [m].
template <class Scalar>
struct PatchLengths {
  explicit PatchLengths(Scalar height) noexcept : band(height), largest_gap(height / 4), seam(height / 100000) {}

  Scalar band;
  Scalar largest_gap;  ///< of a row of features that meet [m]
  Scalar seam;  ///< a point so little beside a face counts as over it, or rounding would let it through between two faces [m]
};

}  // namespace feeler
