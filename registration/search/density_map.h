#pragma once

#include <cstdint>
#include <vector>

#include "registration/mammogram/mammogram_image.h"
#include "registration/search/view_samples.h"
#include "registration/view/detector.h"
#include "registration/view/plates_edge.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

/// From the outline, where the breast is rounded, and from the detector's chest-wall edge: nearer
/// no pattern is compared. Before the plates' rear edge it counts fully from there.
inline constexpr double kPatternInside_mm = 10;

/// Grid of square cells on the detector over which dense tissue is compared; those that count lie
/// well inside the breast, where thickness hardly varies.
struct DensityGrid {
  double cell_mm = 4;
  Eigen::Vector2d first = Eigen::Vector2d::Zero();  ///< middle of the first cell, (u, v) [mm]
  int columns = 0, rows = 0;
  std::vector<std::uint8_t> inside;  ///< by cell, u fastest
  std::vector<int> cells;            ///< those inside

  Eigen::Vector2d middle(int cell) const {
    return first + cell_mm * Eigen::Vector2d(cell % columns, cell / columns);
  }
};

/// Cells at least kPatternInside_mm inside the outline (u, v) of a mammogram and from its edge.
DensityGrid density_grid(const std::vector<Eigen::Vector2d>& outline);

/// How much each cell counts: not at all behind the plates' rear edge, where thickness falls and
/// muscle lies, and fully from kPatternInside_mm before it.
std::vector<double> shares_before(const PlatesEdge& edge, const DensityGrid& grid);

/// Of the counted cells alone, in the order of `cells`.
Eigen::VectorXd in_counted(const DensityGrid& grid, const std::vector<double>& by_cell);

/// The pattern of dense tissue in the counted cells: what is left without its mean over 25 mm, mean
/// 0 and variance 1, each cell counting as its share. It does not change with brightness, contrast
/// or slow shading.
Eigen::VectorXd pattern(const DensityGrid& grid, const std::vector<double>& values,
                        const std::vector<double>& shares);

/// Mean grey of a mammogram in each cell.
std::vector<double> grey_in_cells(const DensityGrid& grid, const MammogramImage& image,
                                  const Detector& detector);

/// The dense tissue of a breast as samples of equal volume.
class DenseTissue {
 public:
  /// Voxels of `fractions` with fibroglandular or lesion tissue inside the prone mesh.
  DenseTissue(const ReducedView& view, const HermiteMesh& prone,
              const Volume<Fractions>& fractions);

  /// Dense volume over each cell [mm^3], spread over neighbours.
  std::vector<double> in_cells(const DensityGrid& grid, const ReducedView& view, const ViewState& z,
                               const Detector& detector) const;

  /// How much there is to compare: the standard deviation of the dense tissue's thickness in the
  /// counted cells, without its mean over 25 mm [mm].
  double detail_mm(const DensityGrid& grid, const ReducedView& view, const ViewState& z,
                   const Detector& detector) const;

  void renew(const ReducedView& view) { samples_.renew(view); }

 private:
  struct Points {
    std::vector<MeshPoint> points;
    std::vector<double> volumes;
  };
  DenseTissue(const ReducedView& view, Points points);
  static Points sampled(const HermiteMesh& prone, const Volume<Fractions>& fractions);

  std::vector<double> volumes_;
  ViewSamples samples_;
};

}  // namespace mammotwin
