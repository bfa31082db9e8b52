#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "segmentation/segmentation.h"

namespace mammotwin {

struct Nipple {
  Eigen::Vector3d tip_in_lps = Eigen::Vector3d::Zero();  ///< [mm]
  /// How surely it shows: SkinPoint's sum there and the papilla's. Where nothing shows, the tip is
  /// the most anterior point.
  double evidence = 0;
  bool is_found = false;
  /// Of the tip, from the other places on the skin that look like it [mm].
  double sd_mm = 0;
  Eigen::Vector3d rival_in_lps = Eigen::Vector3d::Zero();  ///< the best place besides the tip [mm]
  Volume<std::uint8_t> papilla;  ///< what stands out, on a part of the labels' grid; or empty
};

/// The nipple, by what papilla, areola and ducts show (skin_look.h), what stands out as an opening
/// by a ball of 9 mm takes away (1.5 mm and more: its height) and nearness to the most anterior
/// point (25 mm): the middle of the places about the best sum; its standard deviation weighs the
/// other candidates, 12 mm and more apart, by the exponential of what they fall short. Retracted
/// and flat nipples show by brightness, in the skin and below it. Where something stands out, that
/// is the papilla and its tip the nipple.
///
/// `look`: on the labels' grid, papilla and gland brighter than fat.
Nipple find_nipple(const Volume<std::uint8_t>& labels, const BreastRegion& region,
                   const Volume<float>& look);

Nipple mirrored(Nipple nipple);  ///< segmentation/mirrored.h

/// Not found: taken as the most anterior point.
Nipple unknown_nipple(const Volume<std::uint8_t>& labels, const BreastRegion& region);

/// Calls fibroglandular tissue in the papilla skin, as which it counts: it is as bright as gland.
void label_papilla(const Nipple& nipple, Segmentation& s);

}  // namespace mammotwin
