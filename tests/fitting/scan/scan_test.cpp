#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <limits>

#include "fitting/scan/scan_cloud.h"
#include "fitting/scan/scanned_breast.h"
#include "tests/scratch_file.h"

namespace mammotwin {
namespace {

using Points = std::vector<Eigen::Vector3d>;

/// Dome of 40 mm on a plate of 120 mm, 2 mm apart.
Points dome() {
  Points points;
  for (double z = -60; z <= 60; z += 2)
    for (double x = -60; x <= 60; x += 2)
      points.push_back({x, -40 * std::exp(-(x * x + z * z) / (2 * 25 * 25)), z});
  return points;
}

std::filesystem::path file_of(const Points& points, const std::string& name) {
  const std::filesystem::path path = scratch_file(name);
  std::ofstream file(path);
  file.precision(12);
  for (const auto& x : points) file << x.x() << ' ' << x.y() << ' ' << x.z() << '\n';
  return path;
}

std::string refusal(const Points& points, double unit_mm = 1) {
  try {
    read_scan_points(file_of(points, "scan.xyz"), unit_mm);
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

Points scaled(Points points, double factor) {
  for (auto& x : points) x *= factor;
  return points;
}

TEST(ScanCloud, ReadsPointsInTheirUnit) {
  const Points metres = scaled(dome(), 1e-3);
  const Points read = read_scan_points(file_of(metres, "metres.xyz"), 1000);
  EXPECT_EQ(read.size(), dome().size());
  double deepest = 0;
  for (const auto& x : read) deepest = std::min(deepest, x.y());
  EXPECT_NEAR(deepest, -40, 1e-6);  // the file has 12 digits
}

TEST(ScanCloud, ReadsPlyStlAndObj) {
  const std::string folder = scratch_file("").string();
  std::ofstream(folder + "/few.stl") << "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n"
                                        "vertex 1 0 0\nvertex 0 1 0\nendloop\nendfacet\nendsolid\n";
  std::ofstream(folder + "/few.obj") << "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";
  std::ofstream(folder + "/few.ply")
      << "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\n"
         "property float y\nproperty float z\nproperty float nx\n"
         "property float ny\nproperty float nz\nend_header\n"
         "0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n";
  std::ofstream(folder + "/few.xyz") << "0 0 0 0 0 1\n1 0 0 0 0 1\n0 1 0 0 0 1\n";
  for (const char* name : {"few.stl", "few.obj", "few.ply", "few.xyz"}) {
    std::string message;
    try {
      read_scan_points(folder + "/" + name, 1);
    } catch (const std::exception& error) {
      message = error.what();
    }
    EXPECT_NE(message.find("3 distinct points (3 in all)"), std::string::npos) << message;
  }
}

TEST(ScanCloud, NamesWhatIsWrongWithAScan) {
  Points holed = dome();
  holed[7].x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NE(refusal(holed).find("line 8 has a coordinate that is not a number"), std::string::npos)
      << refusal(holed);
  EXPECT_NE(refusal(Points(5000, {1, 2, 3})).find("1 distinct points (5000 in all)"),
            std::string::npos);
  EXPECT_NE(refusal({{1, 2, 3}}).find("expected at least 1000"), std::string::npos);
  Points flat = dome();
  for (auto& x : flat) x.y() = 0.3 * x.x();
  EXPECT_NE(refusal(flat).find("in a plane"), std::string::npos);
  EXPECT_NE(refusal(scaled(dome(), 1e-3)).find("scan.unit_mm = 1000 for metres"),
            std::string::npos);
  EXPECT_NE(refusal(scaled(dome(), 1e3)).find("1.2e+05 mm across"), std::string::npos);
}

TEST(ScanCloud, TakesDuplicatesAsOnePoint) {
  Points twice = dome();
  const Points once = twice;
  twice.insert(twice.end(), once.begin(), once.end());
  EXPECT_EQ(read_scan_points(file_of(twice, "twice.xyz"), 1).size(), once.size());
}

TEST(ScanCloud, TakesOutPointsThatStandAlone) {
  Points points = dome();
  for (int i = 0; i < 10; ++i) points.push_back({10.0 * i - 45, -70, 20.0});
  const ScanCloud cloud = clean_scan(points);
  EXPECT_EQ(cloud.outliers, 10);
  for (const auto& x : cloud.points) EXPECT_GT(x.y(), -41);
}

TEST(ScannedBreast, StandsInFrontOfTheBasePlaneWhicheverWayItWasScanned) {
  Eigen::Isometry3d turn(Eigen::AngleAxisd(0.7, Eigen::Vector3d(1, 2, -1).normalized()));
  turn.translation() = Eigen::Vector3d(300, -200, 50);
  Points turned;
  for (const auto& x : dome()) turned.push_back(turn * x);
  ScannedSkinOptions options;
  options.up = turn.linear() * Eigen::Vector3d::UnitZ();
  const ScannedBreast scanned = read_scanned_breast(file_of(turned, "turned.xyz"), options);
  EXPECT_EQ(scanned.holes, 0);
  // The rim lies at y = 0 but for the bell's foot (0.6 to 2.2 mm), the base 10 mm behind it.
  EXPECT_NEAR(scanned.segmentation.nipple_in_lps.y(), -50 + 1.4, 1.5);
  EXPECT_NEAR(scanned.segmentation.nipple_in_lps.x(), 0, 2);
  EXPECT_NEAR(scanned.segmentation.nipple_in_lps.z(), 0, 2);
  const Eigen::Vector3d tip = scanned.frame_from_file * (turn * Eigen::Vector3d(0, -40, 0));
  EXPECT_LT((tip - scanned.segmentation.nipple_in_lps).norm(), 3);  // voxels of 1 mm, flat tip
}

TEST(ScannedBreast, FillsHolesAndFitsTheSkin) {
  Points points;
  for (const auto& x : dome())
    if (std::hypot(x.x() - 20, x.z()) > 8) points.push_back(x);
  const ScannedBreast scanned = read_scanned_breast(file_of(points, "hole.xyz"), {});
  EXPECT_EQ(scanned.holes, 1);
  FitOptions fit;
  fit.elements = Eigen::Vector3i(4, 4, 2);
  const FitReport report = fit_breast(scanned.segmentation, fit, {}, &scanned.skin).report;
  EXPECT_TRUE(report.usable());
  EXPECT_LT(report.skin_rms_data_to_mesh_mm, 0.3);  // a bell of 25 mm on elements of 20 to 30
}

}  // namespace
}  // namespace mammotwin
