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
  marker,          ///< a round metal marker (BB) that the radiographer stuck on it
  profile,         ///< it stands out of the skin
  not_in_profile,  ///< brightness behind the skin and where nipples usually are
  said             ///< by patient.toml
};
const char* name_of(NippleEvidence evidence);

/// The breast in a mammogram, in pixels (column, row); standard deviations in mm.
struct MammogramFindings {
  ImageEdge chest_wall = ImageEdge::left;
  std::vector<Eigen::Vector2d> outline;  ///< skin line, from top to bottom, about 0.4 mm apart
  double outline_sd_mm = 0;              ///< across it

  Eigen::Vector2d nipple = Eigen::Vector2d::Zero();
  double nipple_sd_mm = 0;  ///< of its distance, of all places that are possible
  NippleEvidence evidence = NippleEvidence::profile;
  struct Candidate {
    Eigen::Vector2d pixel;
    double probability;
  };
  std::vector<Candidate> nipples;  ///< most probable first

  /// Front edge of the pectoral muscle, straight: from the image's top to the chest wall or bottom.
  std::optional<std::pair<Eigen::Vector2d, Eigen::Vector2d>> pectoral;
  std::vector<Eigen::Vector2d> pectoral_curve;  ///< as it was followed, as far as it is seen
  double pectoral_sd_mm = 0;                    ///< across it

  /// Of "outline", "nipple", "pectoral", "view": what nobody should rely on.
  std::vector<std::string> unsure;
  std::vector<std::string> remarks;  ///< what was cut off, missed or doubted, and what to do
  std::string view_doubt;            ///< of these, why it may be of another view; empty: it is not
};

/// What somebody says of a mammogram in place of what would be found, in pixels.
struct SaidFindings {
  std::optional<Eigen::Vector2d> nipple;
  std::optional<std::pair<Eigen::Vector2d, Eigen::Vector2d>> pectoral;  ///< two points of the edge
  std::optional<MammogramImage> mask;    ///< of the image's size, the breast above 0
  std::vector<Eigen::Vector2d> outline;  ///< from one end to the other
};

/// Finds outline, nipple and, in an oblique view, the pectoral edge of a mammogram in which the
/// breast is bright on dark air and touches one vertical edge.
///
/// An outline that is ragged, a nipple with a standard deviation of more than 5 mm, and a pectoral
/// edge with one of more than 5.6 mm or none at all, are named in `unsure`; so is the view where a
/// CC shows the muscle of an MLO or an MLO shows none. Throws std::runtime_error with what to do if
/// no such breast is there.
MammogramFindings find_breast(const MammogramImage& image, double pixel_mm, bool oblique,
                              const SaidFindings& said = {});

}  // namespace mammotwin
