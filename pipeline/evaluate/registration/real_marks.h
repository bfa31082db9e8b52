#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "registration/view/detector.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

/// A lesion that somebody marked on a mammogram: a line of `marks.csv`.
struct RealMark {
  std::string lesion, view;      ///< as in lesions.csv: "L1", "cc"
  Eigen::Vector2d column_row{};  ///< pixels of the image as it is stored
  /// Of a mammogram that is not there: size of a pixel, and the column on which the detector's
  /// chest-wall edge lies.
  std::optional<double> pixel_spacing_mm, edge_column;
  bool assumed = false;  ///< the spacing
};

/// Columns lesion, view, column, row, pixel_spacing_mm, spacing ("known", "assumed" or empty),
/// edge_column; the last three empty where patient.toml or the mammogram's header says it. Throws
/// std::runtime_error naming file, line and cell.
std::vector<RealMark> read_real_marks(const std::filesystem::path& path);

/// Where a mark lies on the detector [mm]: u, and v where the detector's pixels are known.
struct PlacedMark {
  double u_mm = 0;
  std::optional<double> v_mm;
};

/// Empty where nothing says how far a column is from the detector's edge. Of a mark without its
/// image, columns grow from the edge of a left breast and fall from that of a right one.
std::optional<PlacedMark> placed(const RealMark& mark, const Detector& detector, Side side);

}  // namespace mammotwin
