#pragma once

#include <optional>
#include <string>
#include <vector>

#include "registration/mammogram/mammogram_header.h"
#include "registration/mammogram/slice_places.h"
#include "registration/view/detector.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

/// What patient.toml says instead of a header; what is set here is not asked of the header.
struct HeaderOverrides {
  std::optional<double> thickness_mm, angle_deg, source_distance_mm, support_gap_mm,
      pixel_spacing_mm;
  std::optional<ImageEdge> chest_wall;
  std::optional<bool> lateral_at_top;
  SliceOverrides slices;
};

/// Geometry of a view as its header gives it.
struct HeaderGeometry {
  double angle_deg = 0;  ///< in this project's sense
  std::optional<double> thickness_mm;
  std::optional<double> force_N;
  Detector detector;                 ///< with its pixel grid
  std::vector<std::string> remarks;  ///< what was assumed or looks odd, each naming its tag
};

/// "cc", "mlo", another view in lower case, or empty where no tag says it.
std::string view_said_in(const MammogramHeader& header);

/// Side as laterality says it; left where it says neither, which `header_geometry` refuses.
Side side_said_in(const MammogramHeader& header);

/// Judges a header against the view that is asked for ("cc", "mlo") and the MRI's side.
///
/// A tomosynthesis volume is seen from infinitely far: its slices' pixels have one size at any
/// height, that of the breast's plane. With an overriding source distance they lie along rays.
///
/// Throws std::runtime_error "<tag> <name> ..." for what cannot be used: another modality, view or
/// side; magnification, spot and partial views, implants, several frames that are no tomosynthesis
/// volume; a number that is missing and not replaceable, or absurd. Remarks: a missing angle (45
/// for MLO), thickness or distance, a force that only makes sense in dN, PixelSpacing in place of
/// ImagerPixelSpacing, either sign of the angle. Tags and traps: Rows of PS3.3 C.8.11.7; force in
/// dN from one vendor (OpenREM issue 135).
HeaderGeometry header_geometry(const MammogramHeader& header, const std::string& view, Side side,
                               const HeaderOverrides& overrides = {});

}  // namespace mammotwin
