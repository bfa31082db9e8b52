#pragma once

#include <cmath>
#include <random>

#include "registration/carry/point_carrier.h"
#include "registration/search/view_match.h"
#include "tests/registration/squeezed_box.h"

namespace mammotwin {

/// All outer faces of the box are skin but the one on the chest wall.
inline std::vector<FaceLabels> skin_of(const HermiteMesh& box) {
  FaceLabels skin;
  skin.fill(FaceLabel::skin);
  skin[3] = FaceLabel::chest_wall;  // y = 0
  return std::vector<FaceLabels>(box.num_elements(), skin);
}

/// Gland in strands and lumps of 15 to 40 mm, other ones for each seed.
inline Volume<Fractions> gland(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> uniform;
  std::vector<Eigen::Vector4d> waves;
  for (int n = 0; n < 12; ++n) {
    const double angle = 2 * M_PI * uniform(random), length = 15 + 25 * uniform(random);
    waves.push_back({2 * M_PI / length * std::cos(angle), 2 * M_PI / length * std::sin(angle),
                     0.1 * uniform(random), 2 * M_PI * uniform(random)});
  }
  Volume<Fractions> volume({50, 30, 40}, Eigen::Vector3d::Constant(2), {21, -59, -39});
  for (int k = 0; k < 40; ++k)
    for (int j = 0; j < 30; ++j)
      for (int i = 0; i < 50; ++i) {
        double sum = 0;
        for (const Eigen::Vector4d& w : waves)
          sum += std::cos(w.head<3>().dot(volume.position(i, j, k)) + w[3]);
        volume(i, j, k) = pure_fractions(sum > 0 ? label::fibroglandular : label::fat);
      }
  return volume;
}

/// The squeezed box as a view that gets wider by 5 % a standard deviation of `kThickness`.
struct BoxView {
  SqueezedBox box = squeezed_box(Side::left, 0, 0.5);
  ReducedView view;
  Detector detector;
  BoxView() {
    view.elements = box.compressed.elements();
    view.base = in_view(box.compressed.nodes(), box.view.frame);
    ReducedView::Mode& mode = view.modes[kThickness];
    mode.linear = view.base;
    for (HermiteMesh::Node& node : mode.linear)
      node = (Eigen::Vector3d(0.05, 0.05, 0).asDiagonal() * node).eval();
    mode.quadratic.assign(view.base.size(), HermiteMesh::Node::Zero());
  }
  Eigen::Vector3d nipple() const { return {70, -60, 0}; }  // middle of the front

  /// Outline and nipple of a mammogram of `seen` in state z.
  ViewEvidence evidence(const ReducedView& seen, const ViewState& z) const {
    const Eigen::Vector2d centre(0, 0);
    const RayDistances reach = Silhouette(seen, skin_of(box.prone)).at(seen, z, detector, centre);
    ViewEvidence e;
    for (int ray = 0; ray < kRays; ++ray)
      if (reach[ray]) e.outline.push_back(*reach[ray] * ray_direction(ray));
    const PointCarrier carrier(box.prone, HermiteMesh(view.base, view.elements));
    const ViewSamples sample(seen, {carrier.carry(nipple()).point});
    e.nipple = detector.project(sample.at(seen, z).col(0));
    return e;
  }

  ViewMatch match(const ViewState& z) const {
    return ViewMatch(view, skin_of(box.prone), box.prone, nullptr, nipple(), detector,
                     evidence(view, z));
  }
};

}  // namespace mammotwin
