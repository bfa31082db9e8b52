#include "registration/search/view_match.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "registration/carry/point_carrier.h"
#include "registration/search/huber.h"

namespace mammotwin {
namespace {

constexpr double kPiece_mm = 30;       // of outline that counts as one observation
constexpr double kBehind_mm = 8;       // nearer to the detector's edge no outline is compared
constexpr double kBorder_mm = 3;       // of the image: an outline there is the image's end
constexpr double kLeastNipple_mm = 3;  // sd: what the model knows of its own
constexpr double kHuber = 2;           // standard deviations beyond which outliers count less
/// Of dense tissue's thickness. Reckoned, not measured: vessels and ligaments in fat, 2 to 3 mm
/// thick and no gland in the MRI, would vary it as much over cells of 4 mm. Synthetic patients with
/// 10 to 34 % of gland have 2 to 12.
constexpr double kLeastDetail_mm = 1;

/// Share of an independent piece of outline that lies between two rays.
double piece(double radius_mm) {
  return std::min(1.0, radius_mm * 3 * M_PI / 180 / kPiece_mm);  // rays every 3 degrees
}

/// Where the nipple goes: with its nearest tissue, its offset as it lies in the computed view.
struct CarriedNipple {
  MeshPoint point;
  Eigen::Vector3d offset;
};
CarriedNipple carried(const ReducedView& view, const HermiteMesh& prone,
                      const Eigen::Vector3d& nipple_in_lps) {
  const HermiteMesh compressed(view.base, view.elements);
  const CarriedPoint found = PointCarrier(prone, compressed).carry(nipple_in_lps);
  return {found.point, found.in_lps - compressed.position(found.point)};
}

double cross(const Eigen::Vector2d& a, const Eigen::Vector2d& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Muscle is dense, and no tissue of the breast: its cells, on the other side of its edge than the
/// nipple, do not count.
void leave_out_muscle(const MammogramFindings& findings, const Detector& detector,
                      DensityGrid& grid) {
  if (!findings.pectoral) return;
  const Eigen::Vector2d top = detector.detector_from_image(findings.pectoral->first);
  const Eigen::Vector2d way = detector.detector_from_image(findings.pectoral->second) - top;
  const double nipple = cross(way, detector.detector_from_image(findings.nipple) - top);
  std::erase_if(grid.cells, [&](int cell) {
    const bool muscle = cross(way, grid.middle(cell) - top) * nipple < 0;
    if (muscle) grid.inside[cell] = 0;
    return muscle;
  });
}

Eigen::Vector2d edge_centre(const std::vector<Eigen::Vector2d>& outline) {
  double low = 1e30, high = -1e30;
  for (const Eigen::Vector2d& x : outline) {
    low = std::min(low, x.y());
    high = std::max(high, x.y());
  }
  return {0, (low + high) / 2};
}

}  // namespace

bool surely_in_place(const MatchFigures& left) {
  constexpr double most_outline_mm = 5;
  return left.pattern_correlation && *left.pattern_correlation >= kCorrelationInPlace &&
         left.outline_rms_mm <= most_outline_mm;
}

ViewEvidence view_evidence(const MammogramImage& image, const MammogramFindings& findings,
                           const Detector& detector) {
  ViewEvidence evidence;
  std::vector<Eigen::Vector2d> whole;
  const double border = kBorder_mm / detector.pixels->spacing_mm;
  for (const Eigen::Vector2d& pixel : findings.outline) {
    whole.push_back(detector.detector_from_image(pixel));
    if (pixel.y() > border && pixel.y() < image.rows - 1 - border)
      evidence.outline.push_back(whole.back());
  }
  if (evidence.outline.size() < 2) throw std::runtime_error("the mammogram shows no outline");
  evidence.outline_sd_mm = std::max(kOutlineSd_mm, findings.outline_sd_mm);
  evidence.nipple = detector.detector_from_image(findings.nipple);
  evidence.nipple_sd_mm = std::max(kLeastNipple_mm, findings.nipple_sd_mm);
  evidence.grid = density_grid(whole);
  leave_out_muscle(findings, detector, evidence.grid);
  evidence.grey = grey_in_cells(evidence.grid, image, detector);
  evidence.view_doubt = findings.view_doubt;
  return evidence;
}

ViewMatch::ViewMatch(ReducedView view, const std::vector<FaceLabels>& faces,
                     const HermiteMesh& prone, const Volume<Fractions>* fractions,
                     const Eigen::Vector3d& nipple_in_lps, const Detector& detector,
                     ViewEvidence evidence)
    : view_(std::move(view)),
      detector_(detector),
      evidence_(std::move(evidence)),
      centre_(edge_centre(evidence_.outline)),
      seen_(distances_along_rays(evidence_.outline, centre_)),
      silhouette_(view_, faces),
      nipple_([&] {
        const CarriedNipple nipple = carried(view_, prone, nipple_in_lps);
        return ViewSamples(view_, {nipple.point}, {nipple.offset});
      }()) {
  for (int ray = 0; ray < kRays; ++ray)
    if (seen_[ray] && *seen_[ray] * ray_direction(ray).x() < kBehind_mm) seen_[ray].reset();
  if (!fractions) return;
  tissue_ = std::make_shared<DenseTissue>(view_, prone, *fractions);
  compared_ =
      in_counted(evidence_.grid, shares_before(view_.plates_edge(view_.mean()), evidence_.grid))
          .sum();
  detail_mm_ = tissue_->detail_mm(evidence_.grid, view_, view_.mean(), detector_);
  if (*detail_mm_ < kLeastDetail_mm) tissue_.reset();
}

void ViewMatch::renew(ReducedView view) {
  view_ = std::move(view);
  silhouette_.renew(view_);
  nipple_.renew(view_);
  if (tissue_) tissue_->renew(view_);
}

ViewMatch::Patterns ViewMatch::patterns(const ViewState& z) const {
  const DensityGrid& grid = evidence_.grid;
  const std::vector<double> shares = shares_before(view_.plates_edge(z), grid);
  const Eigen::VectorXd weight = in_counted(grid, shares);
  const double all = weight.sum();
  if (all == 0)
    return {Eigen::VectorXd::Zero(weight.size()),
            Eigen::VectorXd::Constant(weight.size(), std::sqrt(compared_ / weight.size()))};
  const auto weighed = [&](const std::vector<double>& values) {
    return Eigen::VectorXd(pattern(grid, values, shares).array() *
                           (weight.array() * (compared_ / all)).sqrt());
  };
  return {weighed(tissue_->in_cells(grid, view_, z, detector_)), weighed(evidence_.grey)};
}

Eigen::VectorXd ViewMatch::residuals(const ViewState& z, bool with_pattern,
                                     const MatchNoise& noise) const {
  const bool patterned = with_pattern && tissue_;
  Eigen::VectorXd r =
      Eigen::VectorXd::Zero(kRays + 2 + (patterned ? evidence_.grid.cells.size() : 0));
  const RayDistances found = silhouette_.at(view_, z, detector_, centre_);
  for (int ray = 0; ray < kRays; ++ray) {
    if (!seen_[ray] || !found[ray]) continue;
    r[ray] = std::sqrt(piece(*seen_[ray])) *
             huber((*found[ray] - *seen_[ray]) / noise.outline_mm, kHuber);
  }
  if (evidence_.nipple) {
    const Eigen::Vector2d miss =
        (detector_.project(nipple_.at(view_, z).col(0)) - *evidence_.nipple) /
        evidence_.nipple_sd_mm;
    r[kRays] = huber(miss.x(), kHuber);
    r[kRays + 1] = huber(miss.y(), kHuber);
  }
  if (patterned) {
    const double share = evidence_.grid.cell_mm / kPatternPiece_mm;
    const Patterns both = patterns(z);
    r.tail(both.seen.size()) = (both.found - both.seen) * (share / noise.pattern);
  }
  return r;
}

double ViewMatch::observations(bool with_pattern) const {
  double count = evidence_.nipple ? 2 : 0;
  for (const auto& radius : seen_)
    if (radius) count += piece(*radius);
  if (with_pattern && tissue_)
    count += compared_ * std::pow(evidence_.grid.cell_mm / kPatternPiece_mm, 2);
  return count;
}

MatchFigures ViewMatch::figures(const ViewState& z) const {
  MatchFigures figures;
  const RayDistances found = silhouette_.at(view_, z, detector_, centre_);
  int count = 0;
  for (int ray = 0; ray < kRays; ++ray)
    if (seen_[ray] && found[ray]) {
      figures.outline_rms_mm += std::pow(*found[ray] - *seen_[ray], 2);
      ++count;
    }
  figures.outline_rms_mm = std::sqrt(figures.outline_rms_mm / std::max(1, count));
  figures.nipple_sd_mm = evidence_.nipple_sd_mm;
  if (evidence_.nipple)
    figures.nipple_mm = (detector_.project(nipple_.at(view_, z).col(0)) - *evidence_.nipple).norm();
  figures.dense_detail_mm = detail_mm_;
  figures.view_doubt = evidence_.view_doubt;
  if (tissue_) {
    const Patterns both = patterns(z);
    figures.pattern_correlation = both.found.dot(both.seen) / compared_;
  }
  return figures;
}

}  // namespace mammotwin
