#pragma once

#include <vector>

#include "registration/mammogram/skin_line.h"
#include "registration/mammogram/upright_image.h"

namespace mammotwin {

/// What each point of a skin line says of a nipple there.
struct NippleProfile {
  std::vector<Eigen::Vector2d> points;  ///< (depth, row) [mm], every half millimetre
  std::vector<double> bulge_mm;         ///< out of a smooth curve through its flanks
  std::vector<double> glow;             ///< brightness inside the skin over its flanks', in sds
};

/// Throws std::runtime_error where the skin is shorter than 44 mm.
NippleProfile nipple_profile(const SkinLine& skin, const UprightImage& smooth);

/// A place where the nipple may be.
struct NippleCandidate {
  Eigen::Vector2d place = Eigen::Vector2d::Zero();  ///< (depth, row) [mm]
  double probability = 0;
  double bulge_mm = 0;
};

struct NippleFinding {
  std::vector<NippleCandidate> candidates;  ///< most probable first
  double sd_mm = 0;  ///< about the first one: of reading it, and of all that is likely beyond it
  bool in_profile = false;  ///< it stands out of the skin
};

/// The nipple by bulge, brightness and where nipples are, each point of the skin weighed by its
/// likelihood.
NippleFinding find_nipple(const NippleProfile& profile, bool oblique);

}  // namespace mammotwin
