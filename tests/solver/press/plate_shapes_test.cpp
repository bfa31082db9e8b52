#include <gtest/gtest.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <numbers>
#include <random>

#include "solver/contact/plate_mesh.h"

namespace mammotwin {
namespace {

using Eigen::Vector3d;

/// A plate of 100 x 60 mm (flat part 80 x 40) in a turned frame.
Plate small_plate() {
  const Eigen::Matrix3d R(Eigen::AngleAxisd(0.6, Vector3d(1, 2, -1).normalized()));
  Plate plate{{1, 2, 3}, R * Vector3d(0, 0, 1), R * Vector3d(1, 0, 0), 10, false};
  plate.length = 80;
  plate.half_width = 20;
  return plate;
}

/// Gap, normal and Hessian against central differences where the curvature is continuous.
void expect_derivatives(const std::function<Gap(const Vector3d&)>& gap, const Vector3d& x) {
  constexpr double h = 1e-5;
  const Gap exact = gap(x);
  for (int k = 0; k < 3; ++k) {
    const Gap plus = gap(x + h * Vector3d::Unit(k)), minus = gap(x - h * Vector3d::Unit(k));
    if ((plus.hessian - minus.hessian).norm() > 1e-3) continue;  // where regions meet
    EXPECT_NEAR((plus.gap - minus.gap) / (2 * h), exact.normal[k], 1e-7);
    EXPECT_NEAR(((plus.normal - minus.normal) / (2 * h) - exact.hessian.col(k)).norm(), 0, 1e-6);
  }
}

TEST(FinitePlate, GapIsTheDistanceToFaceEdgesAndCorners) {
  const Plate plate = small_plate();
  const auto gap = [&](double x, double y, double z) {
    return plate.gap(plate.from_local({x, y, z})).gap;
  };
  EXPECT_NEAR(gap(40, 5, 3), 3, 1e-12);
  EXPECT_NEAR(gap(80, -20, -2), -2, 1e-12);
  // Edges are quarter circles of 10 mm whose centres lie 10 below the flat part's rim.
  EXPECT_NEAR(gap(40, 20 + 3, -10 + 4), 5 - 10, 1e-12);
  EXPECT_NEAR(gap(40, -20 - 9, -10 + 12), 15 - 10, 1e-12);
  EXPECT_NEAR(gap(80 + 12, 0, -10 + 9), 15 - 10, 1e-12);
  EXPECT_NEAR(gap(40, 33, -30), 3, 1e-12) << "the wall below the edge";
  // Corner: distance (2, 3, 6) -> 7 from the rim's corner.
  EXPECT_NEAR(gap(80 + 2, 20 + 3, -10 + 6), 7 - 10, 1e-12);
  EXPECT_NEAR(gap(-3, -20 - 4, -30), 5 - 10, 1e-12);
}

TEST(FinitePlate, NormalAndHessianAreDerivativesOfTheGap) {
  const Plate plate = small_plate();
  std::mt19937 random(8);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * (random() / 4294967295.0);
  };
  for (int trial = 0; trial < 400; ++trial)
    expect_derivatives([&](const Vector3d& x) { return plate.gap(x); },
                       plate.from_local({uniform(-15, 95), uniform(-35, 35), uniform(-25, 10)}));
}

/// A folder of its own, so that tests may run at once.
std::filesystem::path file(const std::string& name) {
  const auto* test = testing::UnitTest::GetInstance()->current_test_info();
  const auto folder =
      std::filesystem::temp_directory_path() / ("mammotwin-plate-" + std::string(test->name()));
  std::filesystem::create_directories(folder);
  return folder / name;
}

/// z = height(x, y) over [0, length] x [-width/2, width/2] as facets about `step` wide, times
/// scale.
std::filesystem::path sheet(const std::function<double(double, double)>& height, double length,
                            double width, double step, double scale = 1, bool upside_down = false) {
  const auto path = file("plate.stl");
  std::ofstream out(path);
  out.precision(12);
  out << "solid plate\n";
  const auto corner = [&](double x, double y) {
    out << "vertex " << scale * x << ' ' << scale * y << ' ' << scale * height(x, y) << '\n';
  };
  const auto facet = [&](double x0, double y0, double x1, double y1, double x2, double y2) {
    out << "facet normal 0 0 0\nouter loop\n";
    corner(x0, y0);
    if (upside_down) std::swap(x1, x2), std::swap(y1, y2);
    corner(x1, y1);
    corner(x2, y2);
    out << "endloop\nendfacet\n";
  };
  for (double x = 0; x < length - 1e-9; x += step)
    for (double y = -width / 2; y < width / 2 - 1e-9; y += step) {
      facet(x, y, x + step, y, x + step, y + step);
      facet(x, y, x + step, y + step, x, y + step);
    }
  out << "endsolid plate\n";
  return path;
}

double level(double, double) { return 0; }

TEST(PlateMesh, FlatFacetsAreAFlatPlate) {
  const PlateMesh mesh = PlateMesh::read(sheet(level, 60, 60, 20));
  for (const double z : {5.0, 0.0, -3.0, -40.0}) {  // -40: far below the grid
    const Gap gap = mesh.gap({30, 4, z});
    // The reader keeps single precision; B-splines reproduce what is linear.
    EXPECT_NEAR(gap.gap, z, 1e-5);
    EXPECT_NEAR((gap.normal - Vector3d::UnitZ()).norm(), 0, 1e-5);
    EXPECT_NEAR(gap.hessian.norm(), 0, 1e-5);
  }
  EXPECT_GT(mesh.gap({200, 0, -1}).gap, 0) << "beside the plate";
}

// A vault of radius 80 mm in facets s wide: these lie between 0 and s²/(8R) inside the cylinder.
TEST(PlateMesh, CurvedFacetsAreTheSurfaceThatTheyApproximate) {
  constexpr double R = 80, step = 1;
  const PlateMesh mesh = PlateMesh::read(
      sheet([](double, double y) { return std::sqrt(R * R - y * y) - R; }, 60, 60, step));
  const double inside = step * step / (8 * R);
  for (const double angle : {-0.2, 0.0, 0.1})
    for (const double gap : {-2.0, 1.0}) {
      const Vector3d x(30, (R + gap) * std::sin(angle), (R + gap) * std::cos(angle) - R);
      EXPECT_NEAR(mesh.gap(x).gap, gap + inside / 2, 0.6 * inside);
    }
}

TEST(PlateMesh, NormalAndHessianAreDerivativesOfTheGap) {
  const PlateMesh mesh = PlateMesh::read(
      sheet([](double x, double y) { return -x * x / 200 - y * y / 150; }, 60, 60, 6));
  std::mt19937 random(9);
  const auto uniform = [&](double low, double high) {
    return low + (high - low) * (random() / 4294967295.0);
  };
  for (int trial = 0; trial < 200; ++trial)
    expect_derivatives([&](const Vector3d& x) { return mesh.gap(x); },
                       {uniform(2, 58), uniform(-28, 28), uniform(-60, 5)});
}

TEST(PlateMesh, AClosedBoxPushesWhatIsDeepInsideOutThroughItsFace) {
  const auto path = file("box.stl");
  std::ofstream out(path);
  out << "solid box\n";
  const auto quad = [&](Vector3d a, Vector3d b, Vector3d c, Vector3d d) {
    for (const auto& [p, q, r] : {std::tuple{a, b, c}, std::tuple{a, c, d}})
      out << "facet normal 0 0 0\nouter loop\nvertex " << p.transpose() << "\nvertex "
          << q.transpose() << "\nvertex " << r.transpose() << "\nendloop\nendfacet\n";
  };
  const double x = 100, y = 50, z = -4;  // a thin plate
  quad({0, -y, 0}, {x, -y, 0}, {x, y, 0}, {0, y, 0});
  quad({0, -y, z}, {0, y, z}, {x, y, z}, {x, -y, z});
  quad({0, -y, z}, {x, -y, z}, {x, -y, 0}, {0, -y, 0});
  quad({x, -y, z}, {x, y, z}, {x, y, 0}, {x, -y, 0});
  quad({x, y, z}, {0, y, z}, {0, y, 0}, {x, y, 0});
  quad({0, y, z}, {0, -y, z}, {0, -y, 0}, {0, y, 0});
  out << "endsolid box\n";
  out.close();
  const PlateMesh mesh = PlateMesh::read(path);
  for (const double depth : {1.0, 3.0, 9.0, 50.0}) {
    const Gap gap = mesh.gap({50, 0, -depth});
    EXPECT_NEAR(gap.gap, -depth, 0.05 * depth + 1e-3) << depth;
    EXPECT_GT(gap.normal.z(), 0.9) << depth;
  }
}

std::string refusal(const std::filesystem::path& path) {
  try {
    PlateMesh::read(path);
  } catch (const std::invalid_argument& error) {
    return error.what();
  }
  return "";
}

TEST(PlateMesh, RefusesWhatIsNoPlate) {
  EXPECT_NE(refusal(file("none.stl")).find("no such file"), std::string::npos);
  std::ofstream(file("empty.stl")) << "solid plate\nendsolid plate\n";
  EXPECT_NE(refusal(file("empty.stl")).find("holds no facets"), std::string::npos);
  std::ofstream(file("text.stl")) << "this is not a plate";
  EXPECT_NE(refusal(file("text.stl")).find("holds no facets"), std::string::npos);
  EXPECT_NE(refusal(sheet(level, 60, 60, 20, 0.1)).find("is it in mm?"), std::string::npos);
  EXPECT_NE(refusal(sheet(level, 60, 60, 20, 1000)).find("is it in mm?"), std::string::npos);
  EXPECT_NE(refusal(sheet(level, 60, 60, 20, 1, true)).find("faces +z"), std::string::npos);
}

}  // namespace
}  // namespace mammotwin
