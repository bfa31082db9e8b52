#include "segmentation/chest_wall/muscle_slips.h"

#include <gtest/gtest.h>

#include <cmath>

namespace mammotwin {
namespace {

constexpr double axis_y = 60, wall_radius = 60, skin_y = -40;
constexpr float fat = 1, muscle = 1.6F;

/// A block of fat in front of a round wall, muscle behind it; the patient's left half.
struct Chest {
  PectoralWall wall;
  Volume<float> image{{80, 100, 40}, Eigen::Vector3d::Ones(), {0, skin_y, 0}, fat};
  Volume<float> gland = image.like<float>(0);

  Chest() {
    constexpr double degree = 0.017453292519943295;
    wall.axis_y = axis_y;
    wall.angles = 61, wall.rows = 20;
    wall.first_angle = -90 * degree, wall.angle_step = 3 * degree;
    wall.z_step = 2;
    wall.radius.assign(static_cast<std::size_t>(wall.angles) * wall.rows, wall_radius);
    paint([&](const Eigen::Vector3d& x) { return wall.is_behind(x); }, muscle, 0);
  }

  template <class Holds>
  void paint(const Holds& holds, float brightness, float fraction) {
    for (int k = 0; k < image.size.z(); ++k)
      for (int j = 0; j < image.size.y(); ++j)
        for (int i = 0; i < image.size.x(); ++i)
          if (holds(image.position(i, j, k)))
            image(i, j, k) = brightness, gland(i, j, k) = fraction;
  }
  /// A cylinder along z, some way in front of the wall, straight before the axis plus `x_mm`.
  void add_cylinder(double x_mm, double before_wall_mm, double radius_mm, float brightness) {
    const double y = axis_y - wall_radius - before_wall_mm;
    paint([&](const Eigen::Vector3d& x) { return std::hypot(x.x() - x_mm, x.y() - y) < radius_mm; },
          brightness, 1);
  }
  Volume<std::uint8_t> found() const {
    auto body = image.like<std::uint8_t>(1);
    return muscle_before_wall(half_breast(body, wall, Side::left), wall, gland, image);
  }
};

double ml(const Volume<std::uint8_t>& mask) {
  double sum = 0;
  for (const std::uint8_t value : mask.values) sum += value;
  return sum / 1000;
}

TEST(MuscleSlips, AreTakenWithTheFatBehindThem) {
  Chest chest;
  chest.add_cylinder(6, 7, 4, muscle);
  const Volume<std::uint8_t> found = chest.found();
  const auto at = [&](double y) {
    const Eigen::Vector3i v = found.index({6, y, 20}).array().round().cast<int>();
    return static_cast<int>(found(v.x(), v.y(), v.z()));
  };
  const double wall_y = axis_y - wall_radius;
  EXPECT_EQ(at(wall_y - 7), 1) << "the slip";
  EXPECT_EQ(at(wall_y - 1), 1) << "fat between it and the wall";
  EXPECT_EQ(at(wall_y - 13), 0) << "fat in front of it";
  EXPECT_LT(ml(found), 6) << "an 8 mm wide, 11 mm deep and 40 mm high piece has 3 to 4 ml";
}

TEST(MuscleSlips, AreNotGland) {
  Chest far, vessel, brighter;
  far.add_cylinder(6, 30, 10, muscle);
  EXPECT_EQ(ml(far.found()), 0) << "gland that stands off the wall";
  vessel.add_cylinder(6, 5, 1.5, muscle);
  EXPECT_EQ(ml(vessel.found()), 0) << "too thin";
  brighter.add_cylinder(6, 7, 4, 1.5F * muscle);
  EXPECT_EQ(ml(brighter.found()), 0) << "half as bright again as muscle";
}

TEST(MuscleSlips, LeaveGlandThatBeginsAtTheWall) {
  Chest chest;
  chest.paint([](const Eigen::Vector3d& x) { return x.x() > 2 && x.x() < 30 && x.y() < -3; },
              muscle, 1);
  EXPECT_EQ(ml(chest.found()), 0) << "most of it stands far off the wall";
}

}  // namespace
}  // namespace mammotwin
