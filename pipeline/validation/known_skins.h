#pragma once

#include <filesystem>
#include <nlohmann/json_fwd.hpp>

namespace mammotwin {

/// A skin that is a Hermite surface of 3 x 3 patches itself, its nodes moved by up to 6 mm from a
/// box's front, fitted by distance alone from the flat front: what is left of the distance [mm].
double hermite_skin_left_mm();

/// A scan's fit against the skin that was scanned, root mean square by area [mm].
struct ScanAccuracy {
  double outside_holes_mm = 0, all_mm = 0;
  int holes = 0;
  double noise_mm = 0;  ///< as found
};

/// Of the gel breast's scan with the fit's defaults, against the formula. Throws std::runtime_error
/// where there is no mesh.
ScanAccuracy gel_scan_accuracy(const std::filesystem::path& scan);

/// Both as `cases` of a table for docs/measured.
nlohmann::json known_skins_table(const std::filesystem::path& scan);

}  // namespace mammotwin
