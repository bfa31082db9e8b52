#pragma once

#include <memory>

#include "registration/mammogram/mammogram_findings.h"
#include "registration/search/density_map.h"
#include "registration/search/silhouette.h"

namespace mammotwin {

/// What a search takes for the standard deviation of a model's outline, and of patterns of the same
/// breast, which are normalised; the latter correlate as 1 - sd^2 / 2 where the breast is in place.
inline constexpr double kOutlineSd_mm = 2, kPatternSd = 0.7;
inline constexpr double kCorrelationInPlace = 1 - kPatternSd * kPatternSd / 2;
inline constexpr double kPatternPiece_mm = 15;  ///< square of pattern that is one observation

/// What a mammogram shows of the breast, on the detector [mm].
struct ViewEvidence {
  std::vector<Eigen::Vector2d> outline;  ///< (u, v), without what lies on the image's border
  double outline_sd_mm = kOutlineSd_mm;
  std::optional<Eigen::Vector2d> nipple;
  double nipple_sd_mm = 3;
  DensityGrid grid;
  std::vector<double> grey;  ///< in each cell; its pattern is that of dense tissue
  std::string view_doubt{};  ///< MammogramFindings::view_doubt
};

/// What was found, each with its own standard deviation; what is unsure of it weighs as little as
/// that says. Throws std::logic_error without a pixel grid.
ViewEvidence view_evidence(const MammogramImage& image, const MammogramFindings& findings,
                           const Detector& detector);

struct MatchFigures {
  double outline_rms_mm = 0;
  std::optional<double> nipple_mm;  ///< absent: the mammogram's was not looked for
  double nipple_sd_mm = 0;
  std::optional<double> pattern_correlation;  ///< absent: none to compare
  /// How much pattern the MRI foretells there (DenseTissue::detail_mm); absent: not looked for.
  std::optional<double> dense_detail_mm = {};
  std::string view_doubt{};  ///< the mammogram's
};

/// The pattern correlates as only that of the same breast in place does, and the outline lies
/// within 5 mm of the mammogram's.
bool surely_in_place(const MatchFigures& left);

/// Standard deviations that differences are held against.
struct MatchNoise {
  double outline_mm;
  double pattern = kPatternSd;  ///< of normalised patterns
};

/// How far a view in state z is from its mammogram.
class ViewMatch {
 public:
  /// Without `fractions` the dense pattern is not compared (the baseline's match), nor where they
  /// foretell next to none: the breast is all fat, or what has gland is not in the picture.
  ViewMatch(ReducedView view, const std::vector<FaceLabels>& faces, const HermiteMesh& prone,
            const Volume<Fractions>* fractions, const Eigen::Vector3d& nipple_in_lps,
            const Detector& detector, ViewEvidence evidence);

  /// Differences over their standard deviations: outline, nipple and, if asked, pattern. Neighbours
  /// along the outline or in the pattern tell the same tale, so each counts as the share that it
  /// has in an independent piece (30 mm of outline; 15 mm x 15 mm of pattern).
  Eigen::VectorXd residuals(const ViewState& z, bool with_pattern) const {
    return residuals(z, with_pattern, stated_noise());
  }
  Eigen::VectorXd residuals(const ViewState& z, bool with_pattern, const MatchNoise& noise) const;

  /// The evidence's own.
  MatchNoise stated_noise() const { return {evidence_.outline_sd_mm}; }

  /// How many independent observations the residuals stand for.
  double observations(bool with_pattern) const;

  MatchFigures figures(const ViewState& z) const;
  const ReducedView& view() const { return view_; }
  const Detector& detector() const { return detector_; }

  /// Goes on with the view deformed.
  void deform(const FreeFormDeformation& deformation) { view_.deformation = deformation; }

  /// Goes on with another reduced model of the same view.
  void renew(ReducedView view);

 private:
  /// Of model and mammogram, in the counted cells, each weighed so that its square is `compared_`;
  /// a pattern that is none is 0.
  struct Patterns {
    Eigen::VectorXd found, seen;
  };
  Patterns patterns(const ViewState& z) const;

  ReducedView view_;
  Detector detector_;
  ViewEvidence evidence_;
  Eigen::Vector2d centre_;
  RayDistances seen_;
  Silhouette silhouette_;
  ViewSamples nipple_;
  std::shared_ptr<DenseTissue> tissue_;  ///< none: the pattern is not compared
  double compared_ = 0;  ///< cells, where the search begins: in no state more or less count
  std::optional<double> detail_mm_;
};

}  // namespace mammotwin
