#pragma once

#include <Eigen/Geometry>
#include <string>
#include <vector>

namespace mammotwin {

/// Where one two-dimensional image stands in the patient, as its header says.
struct SlicePlacement {
  std::string name;                         ///< file name (and frame) for messages
  Eigen::Vector3d position;                 ///< centre of the first pixel in LPS [mm]
  Eigen::Vector3d along_row, along_column;  ///< unit vectors in LPS: to the next pixel, next row
  int rows = 0, columns = 0;
  double row_spacing = 0, column_spacing = 0;  ///< distance between rows, between columns [mm]

  Eigen::Vector3d normal() const { return along_row.cross(along_column); }
};

/// Slices no farther apart than this stand at one place.
constexpr double same_place_mm = 0.01;

/// Slices in order along their normal, equally spaced.
struct SliceStack {
  std::vector<std::size_t> order;  ///< order[n] is the index of the n-th slice
  double spacing = 0;              ///< [mm]
};

/// Orders slices along their common normal. Throws std::runtime_error, naming the slices, where
/// they are fewer than two, differ in matrix or pixel size, are not parallel, shift sideways,
/// stand twice at one place, or leave a gap (over 1.5 times the median distance).
SliceStack stack_slices(const std::vector<SlicePlacement>& slices);

/// True if some slices stand at the same place (several phases or echoes in one series).
bool has_repeated_positions(const std::vector<SlicePlacement>& slices);

}  // namespace mammotwin
