#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "segmentation/segmentation.h"

namespace mammotwin {

struct Nipple {
  Eigen::Vector3d tip_in_lps = Eigen::Vector3d::Zero();  ///< [mm]
  /// Of the skin round it; 0: none does, and the tip is the most anterior point.
  double stands_out_mm = 0;
  /// Of the others that stand out, the best one's score over this one's (0 to 1), and its tip.
  double rival_share = 0;
  Eigen::Vector3d rival_in_lps = Eigen::Vector3d::Zero();  ///< [mm]
  Volume<std::uint8_t> papilla;  ///< what stands out, on a part of the labels' grid; or empty
};

/// The nipple as what stands out of the skin near the breast's most anterior point: what an
/// opening by a ball of 9 mm takes away, by 2 mm and more and 0.08 to 3 ml. Of several the one that
/// stands out most, nearness to the most anterior point (30 mm) weighed in. Flat or pressed nipples
/// are not found so: then it is the most anterior point.
Nipple find_nipple(const Volume<std::uint8_t>& labels, const BreastRegion& region);

/// Calls fibroglandular tissue in the papilla skin, as which it counts: it is as bright as gland.
void label_papilla(const Nipple& nipple, Segmentation& s);

}  // namespace mammotwin
