#pragma once

#include "fitting/mesh/hermite_mesh.h"
#include "registration/carry/position_grid.h"
#include "registration/view/compressed_view.h"
#include "registration/view/detector.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

/// Linear attenuation [1/mm] near 20 keV, of the size reported by Johns and Yaffe, Phys. Med. Biol.
/// 32 (1987) 675-695 (not checked against the printed table). They set the contrast of a picture
/// and enter no position.
struct Attenuation {
  double fat = 0.0456;
  double fibroglandular = 0.0802;
  double lesion = 0.0844;
};

/// Plane image over the detector: pixel (i, j) has its centre at first + (i, j) spacing [mm, u and
/// v]; i runs along u, fastest.
struct DetectorImage {
  int columns = 0, rows = 0;
  double spacing_mm = 1;
  Eigen::Vector2d first = Eigen::Vector2d::Zero();
  std::vector<double> values;

  double at(int i, int j) const { return values[static_cast<std::size_t>(j) * columns + i]; }
};

/// What the detector sees of a compressed breast.
struct SimulatedView {
  DetectorImage thickness;    ///< breast that the ray to each pixel passes [mm]
  DetectorImage attenuation;  ///< -ln(I/I0) of the primary beam
};

/// Beer-Lambert along the ray to each pixel: the line integral of attenuation through the
/// compressed breast, tissue read at its prone position (without `fractions`, fat); 0 where the ray
/// meets no breast. No scatter, noise, skin or beam hardening. The mesh begins at the chest wall's
/// front, so the pectoral muscle is not seen.
SimulatedView simulate_view(const HermiteMesh& prone, const HermiteMesh& compressed,
                            const Volume<Fractions>* fractions, const CompressedView& view,
                            const Detector& detector, double spacing_mm = 0.5,
                            const Attenuation& attenuation = {});

/// -ln(I/I0) along the rays from each source [mm, in the view] to the pixels of `frame`, which lies
/// on the support: the projections of a tomosynthesis scan. The rest as `simulate_view`.
std::vector<DetectorImage> simulate_projections(
    const HermiteMesh& prone, const HermiteMesh& compressed, const Volume<Fractions>* fractions,
    const CompressedView& view, const std::vector<Eigen::Vector3d>& sources,
    const DetectorImage& frame, const Attenuation& attenuation = {});

/// Grey in [0, 1] as a mammogram is shown: dense is bright, air black, and the rim's thinner tissue
/// lifted by judging each pixel against fat of the same thickness.
DetectorImage as_shown(const SimulatedView& view, const Attenuation& attenuation = {});

}  // namespace mammotwin
