#pragma once

#include <cstdint>
#include <vector>

namespace mammotwin {

/// A breast between plates: half an ellipse on the detector's chest-wall edge, of even thickness
/// with a round rim, skin of 1.5 mm about fat, blobs of gland, a nipple in profile; an oblique view
/// reaches the image's top and has a muscle.
struct RawBreast {
  bool oblique = false;
  double depth_mm = 90;        ///< of the skin before the nipple
  double half_height_mm = 85;  ///< of the breast along the chest wall
  double thickness_mm = 50;
  double rim_share = 0.5;  ///< width of the rim over the thickness; 0.5 is a half circle
  double gland = 0.5;      ///< most of it that a place holds
};

/// How it was taken and stored.
struct RawExposure {
  int columns = 1200, rows = 1450;
  double pixel_mm = 0.2;
  bool wall_right = false;
  double kvp = 29;
  double open_counts = 8000;  ///< before the heel; a quantum is a count, as in a pixel of 0.1 mm
  double electronic_noise = 4, dark_counts = 0;
  double heel = 0.12;                                         ///< loss at the field's far edge
  double top_mm = 0, bottom_mm = 0, far_mm = 0, wall_mm = 0;  ///< what the collimator covers
  int converter_bits = 14, bits = 14;                         ///< of counts, and of what is stored
  bool logarithmic = false, more_is_darker = false;
  unsigned seed = 1;
};

struct RawMammogram {
  RawBreast breast;
  RawExposure exposure;
  std::vector<std::uint16_t> values;  ///< row by row from the top

  /// Of a place in the image [pixels], beyond the skin and positive outside [mm]; the nipple is no
  /// skin.
  double outside_mm(double column, double row) const;
  double nipple_column() const, nipple_row() const;  ///< its tip [pixels]
  bool is_exposed(double column, double row, double margin_mm) const;
};

/// Beer-Lambert at three energies in a beam from above, with scatter, the heel of the beam, lead
/// letters, collimator, quanta and electronics; then as the detector stores it.
RawMammogram raw_mammogram(const RawBreast& breast, const RawExposure& exposure);

}  // namespace mammotwin
