#include "registration/search/view_refinement.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "tests/registration/box_view.h"

namespace mammotwin {
namespace {

/// Displacements of 2 mm, as smooth as a refinement expects.
FreeFormDeformation drawn_deformation() {
  FreeFormDeformation drawn({0, -80}, {90, 80});
  std::mt19937 random(11);
  std::normal_distribution<double> normal;
  Eigen::Matrix2Xd controls = drawn.controls();
  for (Eigen::Index n = 0; n < controls.cols(); ++n) {
    const Eigen::Vector2d x = drawn.middle(n) / 30;
    controls.col(n) = 2.8 * Eigen::Vector2d(std::sin(x.x() + x.y()), std::cos(x.y() - 1));
  }
  drawn.set_controls(controls);
  return drawn;
}

struct MovedGland {
  BoxView box;
  ViewState z = ViewState::Zero();

  /// Of a mammogram on which gland lies where `deformation` puts it.
  ViewEvidence evidence(const FreeFormDeformation& deformation,
                        const Volume<Fractions>& imaged) const {
    ReducedView seen = box.view;
    seen.deformation = deformation;
    ViewEvidence evidence = box.evidence(seen, z);
    evidence.grid = density_grid(evidence.outline);
    const DenseTissue tissue(box.view, box.box.prone, imaged);
    evidence.grey = tissue.in_cells(evidence.grid, seen, z, box.detector);
    return evidence;
  }

  ViewMatch match(const FreeFormDeformation& deformation, const Volume<Fractions>& imaged,
                  const Volume<Fractions>& in_mri) const {
    return ViewMatch(box.view, skin_of(box.box.prone), box.box.prone, &in_mri, box.nipple(),
                     box.detector, evidence(deformation, imaged));
  }

  /// RMS over tissue in the view of a displacement less another [mm].
  double apart_mm(const FreeFormDeformation& a, const FreeFormDeformation& b) const {
    const HermiteMesh mesh(box.view.base, box.view.elements);
    double squared = 0;
    for (int e = 0; e < mesh.num_elements(); ++e) {
      const Eigen::Vector2d x = mesh.position({e, {0.5, 0.5, 0.5}}).head<2>();
      squared += (a.at(x) - b.at(x)).squaredNorm();
    }
    return std::sqrt(squared / mesh.num_elements());
  }
};

TEST(ViewRefinement, FindsHowTissueMoved) {
  const MovedGland c;
  const FreeFormDeformation truth = drawn_deformation();
  ViewMatch match = c.match(truth, gland(1), gland(1));
  const MatchFigures before = match.figures(c.z);
  const ViewRefinement found = refine_view(match, c.z);
  const double moved = c.apart_mm(truth, {});
  EXPECT_GT(moved, 2);
  EXPECT_LT(c.apart_mm(truth, found.deformation), 0.4 * moved);
  EXPECT_GT(*found.left.pattern_correlation, *before.pattern_correlation);
  EXPECT_LT(found.left.outline_rms_mm, before.outline_rms_mm);
}

TEST(ViewRefinement, MovesNothingThatLiesWhereItShould) {
  const MovedGland c;
  ViewMatch match = c.match({}, gland(1), gland(1));
  const ViewRefinement found = refine_view(match, c.z);
  EXPECT_LT(c.apart_mm({}, found.deformation), 0.05);
}

// A mammogram that shows muscle behind the plates' edge.
TEST(ViewMatch, ComparesNoPatternBehindThePlatesEdge) {
  MovedGland c;
  c.z[kShiftDepth] = 2;
  const PlatesEdge edge = c.box.view.plates_edge(c.z);
  const Volume<Fractions> in_mri = gland(1);
  ViewEvidence evidence = c.evidence({}, in_mri);
  std::vector<Eigen::Vector2d> whole = evidence.outline;
  whole.insert(whole.begin(), {0, whole.front().y()});
  whole.emplace_back(0, whole.back().y());
  evidence.grid = density_grid(whole);
  evidence.grey = DenseTissue(c.box.view, c.box.box.prone, in_mri)
                      .in_cells(evidence.grid, c.box.view, c.z, c.box.detector);
  int muscle = 0;
  for (const int cell : evidence.grid.cells)
    if (edge.before_mm(evidence.grid.middle(cell)) < 0) {
      evidence.grey[cell] += 1e4 * (1 + muscle % 3);
      ++muscle;
    }
  ASSERT_GT(muscle, 20);
  const ViewMatch match(c.box.view, skin_of(c.box.box.prone), c.box.box.prone, &in_mri,
                        c.box.nipple(), c.box.detector, evidence);
  EXPECT_NEAR(*match.figures(c.z).pattern_correlation, 1, 1e-9);
  EXPECT_LT(*match.figures(ViewState::Zero()).pattern_correlation, 0.9);
}

TEST(ViewRefinement, OtherGlandMovesLittle) {
  const MovedGland c;
  ViewMatch match = c.match({}, gland(2), gland(1));
  const ViewRefinement found = refine_view(match, c.z);
  EXPECT_LT(c.apart_mm({}, found.deformation), 1);
}

}  // namespace
}  // namespace mammotwin
