#include "pipeline/synthesize/gel_breast.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "fitting/scan/scanned_breast.h"
#include "fitting/surface/closest_point.h"
#include "fitting/surface/face_mesh.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

/// Mean square distance of a skin to the true one, by area, and of what lies off the holes.
struct Errors {
  double all = 0, area = 0, outside = 0, outside_area = 0;
};

Errors errors_of(const TriangleSurface& skin, const Eigen::Isometry3d& file_from_frame) {
  const ClosestPoint truth(gel_breast_surface(0.5));
  const ScanHoles holes = gel_breast_holes();
  const std::vector<double> areas = skin.vertex_areas();
  Errors e;
  for (std::size_t v = 0; v < areas.size(); ++v) {
    const Eigen::Vector3d x = file_from_frame * skin.vertices[v];
    const double squared = areas[v] * (truth(x).x - x).squaredNorm();
    e.all += squared, e.area += areas[v];
    const bool in_hole =
        std::any_of(holes.middles.begin(), holes.middles.end(),
                    [&](const Eigen::Vector3d& m) { return (x - m).norm() <= holes.radius_mm; });
    if (!in_hole) e.outside += squared, e.outside_area += areas[v];
  }
  return e;
}

// What the project asks of a scan with 0.3 mm of noise, 1 % outliers and three holes.
TEST(GelBreast, IsFittedToAQuarterMillimetreOfItsTrueSkin) {
  const ScannedBreast breast = read_scanned_breast(
      std::string(MAMMOTWIN_SOURCE_DIR) + "/sample_data/gel_breast/scan.ply", {});
  EXPECT_EQ(breast.holes, 3);
  EXPECT_NEAR(breast.skin.noise_mm, 0.3, 0.1);
  const FitResult fit = fit_breast(breast.segmentation, {}, {}, &breast.skin);
  ASSERT_TRUE(fit.report.usable());
  const TriangleSurface skin =
      face_mesh(fit.mesh.mesh, fit.mesh.faces, FaceLabel::skin, 16).surface;
  const Errors e = errors_of(skin, breast.frame_from_file.inverse());
  const double outside = std::sqrt(e.outside / e.outside_area), all = std::sqrt(e.all / e.area);
  EXPECT_LT(outside, 0.25);
  EXPECT_LT(all, 0.4);
  std::cout << "RMS to the true skin: " << outside << " mm outside the holes, " << all
            << " mm in all\n";
}

}  // namespace
}  // namespace mammotwin
