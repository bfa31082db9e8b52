#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "registration/mammogram/mammogram_findings.h"

namespace mammotwin {

MammogramImage mirror_image(MammogramImage image);  ///< columns in the other order
MammogramImage upside_down(MammogramImage image);   ///< rows in the other order

/// A mammogram after a change that must not matter to what is found in it.
struct ChangedMammogram {
  MammogramImage image;
  double pixel_mm = 0;
  /// Pixel (column, row) of the changed image that shows what the given one of the first shows.
  std::function<Eigen::Vector2d(const Eigen::Vector2d&)> changed_from_first;
};

struct MammogramChange {
  std::string name;
  std::function<ChangedMammogram(const MammogramImage&, double pixel_mm, ImageEdge chest_wall)>
      apply;
};

/// Mirrored; pixels of 0.05, 0.07 and 0.2 mm; 12 bits with noise; half as bright, of other gamma;
/// turned by 5 degrees either way; rows cut off; a white border; letters in a far corner.
std::vector<MammogramChange> mammogram_changes();

/// How far findings moved [mm]: outline_p95_mm (without the outer 15 mm of it), nipple_mm,
/// pectoral_mm (as far as the changed image shows it), their standard deviations before and after,
/// what either was unsure of, and `moved`: what both are sure of and moved by more than its
/// standard deviation (an outline: by more than 3 mm).
nlohmann::json change_row(const MammogramFindings& first, const MammogramFindings& after,
                          const ChangedMammogram& changed);

}  // namespace mammotwin
