#pragma once

#include <Eigen/Core>
#include <optional>
#include <string>
#include <vector>

#include "registration/mammogram/mammogram_image.h"
#include "registration/view/detector.h"

namespace mammotwin {

/// How the nipple was found.
enum class NippleEvidence {
  marker,   ///< a round metal marker (BB) that the radiographer stuck on it
  profile,  ///< farthest point of the outline: rough, centimetres where the nipple is not in
            ///< profile
};

/// The breast in a mammogram, in pixels (column, row).
struct MammogramFindings {
  ImageEdge chest_wall = ImageEdge::left;
  std::vector<Eigen::Vector2d> outline;  ///< skin line, from top to bottom, one point a row
  Eigen::Vector2d nipple = Eigen::Vector2d::Zero();
  NippleEvidence evidence = NippleEvidence::profile;
  /// Edge of the pectoral muscle in an oblique view: from the image's top to the chest wall or
  /// bottom.
  std::optional<std::pair<Eigen::Vector2d, Eigen::Vector2d>> pectoral;
};

/// Finds outline, nipple and, in an oblique view, the pectoral edge of a mammogram in which the
/// breast is bright on dark air and touches one vertical edge.
/// Throws std::runtime_error if no such breast is there.
MammogramFindings find_breast(const MammogramImage& image, bool oblique);

}  // namespace mammotwin
