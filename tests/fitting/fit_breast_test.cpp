#include "fitting/fit_breast.h"

#include <gtest/gtest.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <stdexcept>

#include "fitting/mesh/bezier.h"
#include "fitting/mesh/jacobian_bound.h"
#include "fitting/surface/flatten.h"
#include "fitting/surface/skin_to_fit.h"
#include "tests/fitting/dome.h"

namespace mammotwin {
namespace {

FitOptions coarse() {
  FitOptions options;
  options.elements = Eigen::Vector3i(4, 4, 2);
  return options;
}

const FitResult& fit_of_bell() {
  static const FitResult fit = fit_breast(dome_breast(), coarse());
  return fit;
}

TEST(FitBreast, FitsABellAndProvesItValid) {
  const FitResult& fit = fit_of_bell();
  const FitReport& r = fit.report;
  ASSERT_TRUE(r.usable());
  EXPECT_EQ(r.status, "ok");
  // Marching cubes of a mask strays by 0.29 voxels (uniform error) of 2 mm; the fit adds little.
  EXPECT_LT(r.skin_rms_mesh_to_data_mm, 0.7);
  EXPECT_LT(r.skin_rms_data_to_mesh_mm, 0.7);
  EXPECT_LT(r.chest_wall_rms_mm, 0.3);
  EXPECT_GT(r.covered_fraction, 0.98);
  EXPECT_GT(r.min_jacobian_bound, 0);
  EXPECT_TRUE(proved_valid(fit.mesh.mesh));
  EXPECT_GT(r.min_scaled_jacobian, 0.1);
}

TEST(FitBreast, SideFacesLieInTheRegionsPlanes) {
  const Segmentation s = dome_breast();
  const HermiteMesh& mesh = fit_of_bell().mesh.mesh;
  for (int e = 0; e < mesh.num_elements(); e += 4)
    for (double a : {0.2, 0.7}) {
      EXPECT_NEAR(mesh.position({e, {0, a, 0.4}}).x(), s.region.x_min, 1e-10);
      EXPECT_NEAR(mesh.position({e + 3, {1, a, 0.4}}).x(), s.region.x_max, 1e-10);
    }
}

TEST(FitBreast, PaintsTheDistanceToTheLabelsOnTheSkin) {
  const MeshFile& file = fit_of_bell().mesh;
  const PointField& field = file.fields.at("skin_distance_mm");
  const BezierMesh bezier(file.mesh);
  ASSERT_EQ(field.values.size(), bezier.points.size());
  double low = 0, high = 0;
  for (int e = 16; e < 32; ++e)  // the layer under the skin; its corners hold samples
    for (int corner : {48, 51, 60, 63}) {
      low = std::min(low, field.values[bezier.elements[e][corner]]);
      high = std::max(high, field.values[bezier.elements[e][corner]]);
    }
  EXPECT_LT(low, 0);
  EXPECT_GT(high, 0);
  EXPECT_LE(std::max(-low, high), fit_of_bell().report.skin_max_mm + 1e-9);
}

TEST(FitBreast, LabelsItsFaces) {
  const FitResult& fit = fit_of_bell();
  std::array<int, 4> count{};
  for (const auto& element : fit.mesh.faces)
    for (FaceLabel face : element) ++count[static_cast<int>(face)];
  EXPECT_EQ(count[static_cast<int>(FaceLabel::skin)], 16);
  EXPECT_EQ(count[static_cast<int>(FaceLabel::chest_wall)], 16);
  EXPECT_EQ(count[static_cast<int>(FaceLabel::cut)], 4 * 4 * 2);
}

TEST(FitBreast, IsTheSameBitForBitOnOneTwoAndFourThreads) {
  for (std::size_t threads : {std::size_t{1}, std::size_t{2}, std::size_t{4}}) {
    const tbb::global_control control(tbb::global_control::max_allowed_parallelism, threads);
    EXPECT_EQ(fit_breast(dome_breast(), coarse()).mesh.mesh.nodes(),
              fit_of_bell().mesh.mesh.nodes())
        << threads << " threads";
  }
}

TEST(FitBreast, ItsProgressGrowsToOne) {
  double last = -1;
  fit_breast(dome_breast(), coarse(), [&](double fraction, const std::string& what) {
    EXPECT_GE(fraction, last);
    EXPECT_FALSE(what.empty());
    last = fraction;
  });
  EXPECT_EQ(last, 1);
}

TEST(FitBreast, SaysThatItEndedTooEarlyAndWhatItsIterationsDid) {
  FitOptions options = coarse();
  const FitReport& whole = fit_of_bell().report;
  ASSERT_FALSE(whole.course.empty());
  EXPECT_LT(whole.course.back().skin_rms_mm, whole.course.front().skin_rms_mm);
  options.max_iterations = whole.iterations / 2;
  const FitReport half = fit_breast(dome_breast(), options).report;
  EXPECT_EQ(half.iterations, options.max_iterations);
  ASSERT_FALSE(half.reasons.empty());
  EXPECT_NE(half.reasons.front().find("fit.max_iterations"), std::string::npos);
}

/// The bell with a nipple, a ball of 5 mm radius in its skin off the tip, and the landmark
/// elsewhere.
Segmentation bell_with_nipple(const Eigen::Vector3d& ball, const Eigen::Vector3d& landmark) {
  Segmentation s = dome_breast();
  for (int k = 0; k < s.labels.size.z(); ++k)
    for (int j = 0; j < s.labels.size.y(); ++j)
      for (int i = 0; i < s.labels.size.x(); ++i)
        if ((s.labels.position(i, j, k) - ball).norm() < 5) s.labels(i, j, k) = label::fat;
  s.nipple_in_lps = landmark;
  return s;
}

double nearest_skin_node(const HermiteMesh& mesh, const Eigen::Vector3d& x) {
  double nearest = 1e300;
  const int layer = 25;  // nodes, of 4 x 4 elements
  for (int n = mesh.num_nodes() - layer; n < mesh.num_nodes(); ++n)
    nearest = std::min(nearest, (mesh.node(n).col(0) - x).norm());
  return nearest;
}

// A landmark brings a node to it and makes the mesh follow what stands out of the skin there. With
// the landmark at (-15, -35, 20) the nearest node was 18.5 mm off the ball's tip, the skin 2.5 mm.
TEST(FitBreast, HonoursTheNippleThatIsGiven) {
  // On the bell's skin: -12 - 40 exp(-(64 + 100) / 968) = -45.8.
  const Eigen::Vector3d ball(8, -45.8, -10), tip = ball - Eigen::Vector3d(0, 5, 0);
  const FitResult fit = fit_breast(bell_with_nipple(ball, tip), coarse());
  ASSERT_TRUE(fit.report.usable());
  EXPECT_LT(nearest_skin_node(fit.mesh.mesh, tip), 4);  // a fifth of a column
  EXPECT_LT(fit.report.nipple_error_mm, 2.2);           // a voxel is 2 mm
}

std::string refusal(const Segmentation& s, const FitOptions& options = coarse()) {
  try {
    fit_breast(s, options);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

TEST(FitBreast, RefusesARegionWithoutABreast) {
  Segmentation s = dome_breast();
  for (auto& value : s.labels.values) value = label::air;
  EXPECT_NE(refusal(s).find("voxels of tissue"), std::string::npos);
}

TEST(FitBreast, RefusesSkinThatIsNoDisc) {
  Segmentation s = dome_breast();
  // An arm that lies against the tip and leaves the region 26 mm above the chest.
  for (int k = 0; k < s.labels.size.z(); ++k)
    for (int j = 0; j < s.labels.size.y(); ++j)
      for (int i = 0; i < s.labels.size.x(); ++i) {
        const Eigen::Vector3d x = s.labels.position(i, j, k);
        if (std::abs(x.z()) < 6 && x.x() > 0 && x.y() > -56 && x.y() < -46)
          s.labels(i, j, k) = label::fat;
      }
  s.lesions.push_back({"1", {36, -5, 0}, 0.1});  // so that the region's edge must stay
  EXPECT_NE(refusal(s).find("cannot be laid on a square"), std::string::npos);
}

TEST(SkinToFit, LeavesOutARaggedEdgeAndSaysSo) {
  Segmentation s = dome_breast();
  // A flap that hangs over the upper edge and touches it twice: an arch 20 mm wide and 24 high.
  for (int k = 0; k < s.labels.size.z(); ++k)
    for (int j = 0; j < s.labels.size.y(); ++j)
      for (int i = 0; i < s.labels.size.x(); ++i) {
        const Eigen::Vector3d x = s.labels.position(i, j, k);
        if (x.z() < 37 || std::abs(x.x()) > 30 || x.y() < -52) continue;
        const bool under_the_arch = std::abs(x.x()) < 22 && x.y() > -44;
        if (!under_the_arch && x.y() <= 0) s.labels(i, j, k) = label::fat;
      }
  const SkinToFit skin = find_skin_to_fit(s, find_muscle_front(s.labels, s.region));
  EXPECT_EQ(why_not_a_square(skin.surface, skin.region), "");
  EXPECT_NE(skin.doubt.find("upper edge"), std::string::npos) << skin.doubt;
  EXPECT_LT(skin.region.z_max, s.region.z_max - 2);
  EXPECT_EQ(skin.region.z_min, s.region.z_min);

  Lesion lesion{"1", {0, -5, 40}, 0.1};
  s.lesions.push_back(lesion);
  EXPECT_THROW(find_skin_to_fit(s, find_muscle_front(s.labels, s.region)), std::runtime_error);
}

TEST(SkinToFit, LeavesOutAnEdgeThatTheSkinGrazesAndSaysSo) {
  Segmentation s = dome_breast();
  // A block 50 mm wide and 33 high that ends in a cliff at z = 41, half a millimetre inside.
  s.region.z_max = 41.5;
  for (int k = 0; k < s.labels.size.z(); ++k)
    for (int j = 0; j < s.labels.size.y(); ++j)
      for (int i = 0; i < s.labels.size.x(); ++i) {
        const Eigen::Vector3d x = s.labels.position(i, j, k);
        const bool block = std::abs(x.x()) < 25 && x.z() > 10 && x.z() < 41 && x.y() > -45;
        if (block && s.labels(i, j, k) == label::air) s.labels(i, j, k) = label::fat;
      }
  const SkinToFit skin = find_skin_to_fit(s, find_muscle_front(s.labels, s.region));
  EXPECT_NE(skin.doubt.find("upper edge"), std::string::npos) << skin.doubt;
  // Marching cubes every 2 mm of a Gaussian of 1 mm spread the cliff over some 3 mm.
  EXPECT_LT(skin.region.z_max, 41);
  EXPECT_GE(skin.region.z_max, 41.5 - 6);
  EXPECT_EQ(skin.region.x_max, s.region.x_max);

  const Segmentation plain = dome_breast();
  EXPECT_EQ(find_skin_to_fit(plain, find_muscle_front(plain.labels, plain.region)).doubt, "");
}

TEST(FitBreast, TakesAsManyColumnsAsTheSkinIsLarge) {
  EXPECT_EQ(elements_for(30000), Eigen::Vector3i(9, 9, 2));
  // 65000 mm² / 600 mm² = 108.3, the square of 10.4.
  EXPECT_EQ(elements_for(65000), Eigen::Vector3i(11, 11, 2));
  EXPECT_EQ(elements_for(1e7), Eigen::Vector3i(12, 12, 2));
}

TEST(FitBreast, RefusesOptionsOutOfRange) {
  FitOptions options;
  options.elements = Eigen::Vector3i(0, 6, 2);
  EXPECT_NE(refusal(dome_breast(), options).find("elements"), std::string::npos);
  options = {};
  options.smoothing = 1;
  EXPECT_NE(refusal(dome_breast(), options).find("smoothing"), std::string::npos);
}

}  // namespace
}  // namespace mammotwin
