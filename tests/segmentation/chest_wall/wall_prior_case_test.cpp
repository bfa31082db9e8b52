#include <algorithm>
#include <cmath>
#include <numbers>

#include "segmentation/body/breast_frame.h"
#include "segmentation/chest_wall/wall_prior.h"
#include "segmentation/files/read_labels.h"
#include "segmentation/image/components.h"
#include "tests/segmentation/cases.h"

namespace mammotwin {
namespace {

constexpr double degree = std::numbers::pi / 180;
constexpr double axis_behind_mm = 110;  // as PectoralWall's
constexpr double least_part_ml = 2;
constexpr std::uint16_t muscle_in_maps = 4;

struct Map {
  Volume<std::uint8_t> muscle;
  BreastFrame frame;
};

Map read_map(const std::filesystem::path& path) {
  const Volume<std::uint16_t> values = read_labels(path);
  auto body = values.like<std::uint8_t>(0), muscle = body;
  for (std::size_t v = 0; v < values.values.size(); ++v) {
    body.values[v] = values.values[v] != 0;
    muscle.values[v] = values.values[v] == muscle_in_maps;
  }
  return {without_small_components(muscle, least_part_ml), find_breast_frame(body)};
}

/// The outermost muscle on a ray [mm]; 0: none.
double outermost(const Map& map, double angle, double above_apices) {
  const double z = (map.frame.left_apex.z() + map.frame.right_apex.z()) / 2 + above_apices;
  const double axis_y = map.frame.sternal_y + axis_behind_mm;
  for (double r = 230; r > 30; r -= 0.5) {
    const Eigen::Vector3d x(map.frame.midline_x + r * std::sin(angle), axis_y - r * std::cos(angle),
                            z);
    const Eigen::Vector3i v = map.muscle.index(x).array().round().cast<int>();
    if (map.muscle.contains(v.x(), v.y(), v.z()) && map.muscle(v.x(), v.y(), v.z())) return r;
  }
  return 0;
}

TEST(WallPrior, IsThatOfTheLabelMaps) {
  MAMMOTWIN_NEED_CASE(folder, "label_maps");
  std::vector<Map> maps;
  for (const auto& entry : std::filesystem::directory_iterator(folder))
    if (entry.path().filename().string().rfind("Exam_", 0) == 0)
      maps.push_back(read_map(entry.path()));
  ASSERT_EQ(maps.size(), 10u);
  for (int height = -120; height <= 100; height += 20)
    for (int angle = 0; angle <= 60; angle += 10) {
      double sum = 0;
      int count = 0;
      for (const Map& map : maps)
        for (const int side : {-1, 1})
          if (const double r = outermost(map, side * angle * degree, height); r > 0)
            sum += r, ++count;
      ASSERT_GE(count, 7);
      // The table has one decimal.
      EXPECT_NEAR(usual_radius(angle * degree, height).mean, sum / count, 0.06)
          << angle << " degrees, " << height << " mm";
    }
}

}  // namespace
}  // namespace mammotwin
