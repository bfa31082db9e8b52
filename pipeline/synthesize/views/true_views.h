#pragma once

#include <array>
#include <optional>
#include <string>

#include "fitting/mesh/mesh_file.h"
#include "pipeline/patient/compression_settings.h"
#include "pipeline/patient/gravity_settings.h"
#include "pipeline/synthesize/patient.h"
#include "registration/view/compressed_view.h"
#include "registration/view/detector.h"

namespace mammotwin {

/// How a synthetic patient's view was really taken, against what its header says.
struct DrawnView {
  std::string name;  ///< "cc", "mlo"
  double header_angle_deg = 0;
  double roll_deg = 0;       ///< true positioner angle less the header's
  double turn_deg = 0;       ///< of the breast between the plates, about the beam
  double lift_mm = 0;        ///< of the plates' middle above the breast's centroid
  double clearance_mm = 10;  ///< plates' edge to the chest wall
  double shift_mm = 0;       ///< of the detector's middle from the breast's, sideways
  double compressed_fraction = 0.5;
  double thickness_error_mm = 0;  ///< of the header
  /// CC: detector's edge in front of the plates' edge; behind it (negative), the picture also shows
  /// what lies behind the breast, more of the same tissue.
  double edge_mm = 0;
  /// MLO, whose pictures show muscle behind the breast: how far the breast is turned on the
  /// detector once it is pressed, and its nipple's depth in the picture over its distance from the
  /// chest wall's line (registration/search/edge_prior.h).
  double laid_turn_deg = -25, nipple_share = 0.9;
  bool marker = true;  ///< of metal on the nipple
};

/// Tissue of a true breast, against what the registering model assumes.
struct TrueTissue {
  double stiffness_ratio = 1;  ///< fibroglandular over fat
  double stiffening =
      1;  ///< exponent; 1: at half the thickness, I1 - 3 = 1.25, a modulus of 3.5 times
  double springs = 3;      ///< times those assumed
  double friction = 0.45;  ///< with the plates: typical of dry skin, above what is assumed
  double paddle_tilt_deg = 3;
};

/// A body, its tissue, and how each view of it was taken.
struct DrawnPatient {
  PatientOptions patient;
  TrueTissue tissue;
  Eigen::Vector3i true_elements{8, 8, 3};  ///< of the truth's mesh
  std::optional<Eigen::Vector3i>
      elements;  ///< of the mesh that registers; absent: as `fit` chooses
  std::array<DrawnView, 2> views;
};

/// A synthetic patient's breast in one true view.
struct TrueView {
  CompressedView view;
  HermiteMesh compressed;
  double header_thickness_mm = 0;
  bool marker = true, behind = false;  ///< shown: of metal on the nipple; what lies behind
  /// Of an oblique view, whose picture shows muscle: two points on the wall's line (wall_line), in
  /// LPS, halfway between the plates.
  std::optional<std::array<Eigen::Vector3d, 2>> wall{};
};

/// Truth by another model than the one that registers: exponential stiffening, other springs,
/// friction and paddle (TrueTissue), skin twice as stiff, standing gravity, finer mesh. `unloaded`
/// is the shape free of stress in this model, its configuration "prone" the body as made.
class TrueBreast {
 public:
  TrueBreast(const SyntheticPatient& patient, const DrawnPatient& drawn);

  const HermiteMesh& prone() const { return prone_; }
  const Segmentation& truth() const { return truth_; }

  /// The prone breast, hanging from the chest between two upright plates of a coil that take this
  /// share off its width. Throws std::runtime_error where the plates do not come together so far.
  HermiteMesh between_coil_plates(double share) const;

  /// Throws std::runtime_error where the plates do not come to the thickness.
  TrueView compress_view(const DrawnView& drawn) const;

 private:
  CompressionProblem problem(const CompressionSettings& settings, Pose pose) const;
  /// Where the breast came to lie on its detector, which `shown` says but for that.
  TrueView laid(TrueView shown, const DrawnView& drawn) const;

  Segmentation truth_;
  TrueTissue tissue_;
  Side side_;
  MeshFile unloaded_;
  HermiteMesh prone_;
};

}  // namespace mammotwin
