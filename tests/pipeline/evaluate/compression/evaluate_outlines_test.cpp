#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "pipeline/evaluate/compression/outline_row.h"
#include "pipeline/evaluate/compression/typical_press.h"
#include "pipeline/steps/typical_thickness.h"
#include "registration/view/compressed_view.h"
#include "tests/pipeline/scratch_folder.h"
#include "tests/registration/squeezed_box.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

const std::filesystem::path kOutlines =
    std::filesystem::path(MAMMOTWIN_SOURCE_DIR) / "../shared/cases";

class Outlines : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(kOutlines / "compressed_outlines"))
      GTEST_SKIP() << "the population's outlines are not there";
  }
  OutlinePopulation population() const {
    return OutlinePopulation(kOutlines / "compressed_outlines");
  }
};

// Depth and width of the mean breast at 40, 55 and 70 mm as the case's own description gives them.
TEST_F(Outlines, MeanIsThePublishedOne) {
  const OutlinePopulation p = population();
  const double expected[][3] = {{40, 79.7, 170.6}, {55, 91.1, 185.2}, {70, 103.2, 200.3}};
  for (const auto& [thickness, depth, width] : expected) {
    double far = 0, low = 0, high = 0;
    for (double t = -90; t <= 90; t += 0.5) {
      const double r = p.at(thickness, t).mean_mm;
      far = std::max(far, r * std::cos(t * M_PI / 180));
      low = std::min(low, r * std::sin(t * M_PI / 180));
      high = std::max(high, r * std::sin(t * M_PI / 180));
    }
    EXPECT_NEAR(far, depth, 0.5);
    EXPECT_NEAR(high - low, width, 1);
  }
}

// 360, 613 and 1222 ml by a numpy script over the same tables; a half ellipse as deep and wide as
// the mean at 55 mm, without a rounded rim, would have 729 ml.
TEST_F(Outlines, TypicalThicknessIsThatOfTheVolume) {
  const OutlinePopulation p = population();
  EXPECT_NEAR(p.volume_ml(40), 360, 1);
  EXPECT_NEAR(p.volume_ml(55), 613, 1);
  EXPECT_NEAR(p.volume_ml(80), 1222, 1);
  for (const double thickness : {35.0, 55.0, 80.0})
    EXPECT_NEAR(p.typical_thickness_mm(p.volume_ml(thickness)), thickness, 0.01);
  // What is assumed of a breast has the population's volumes as a table.
  for (const double thickness : {30.0, 45.0, 60.0, 75.0, 90.0})
    EXPECT_NEAR(typical_thickness_mm(p.volume_ml(thickness)), thickness, 0.3);
  EXPECT_NEAR(p.typical_thickness_mm(100), 30, 0.01);
  EXPECT_NEAR(p.typical_thickness_mm(2000), 90, 0.01);
}

TEST_F(Outlines, RefusesThicknessesWithoutPatients) {
  EXPECT_THROW(population().at(25, 0), std::invalid_argument);
  EXPECT_THROW(population().at(95, 0), std::invalid_argument);
}

/// A box 100 sqrt(2) mm wide and 60 sqrt(2) mm deep at 40 mm, whose front and back recede by
/// `slope` towards lateral.
MeshFile pressed_box(double slope) {
  const SqueezedBox box = squeezed_box(Side::left, 0, 0.5);
  std::vector<HermiteMesh::Node> nodes = box.compressed.nodes();
  for (HermiteMesh::Node& node : nodes) {
    node.row(1) += slope * node.row(0);
    node(1, 0) -= slope * 70;
  }
  MeshFile file{HermiteMesh(nodes, box.compressed.elements()), {}, {}, {}, {}, {}};
  FaceLabels skin;
  skin.fill(FaceLabel::skin);
  file.faces.assign(file.mesh.num_elements(), skin);
  write_view(box.view, file.metadata);
  return file;
}

// Its corners are not a breast's.
TEST_F(Outlines, ABoxIsMeasuredAsOne) {
  const nlohmann::json row = outline_row(pressed_box(0), population());
  EXPECT_NEAR(row["depth_mm"].get<double>(), 60 * std::sqrt(2), 0.1);
  // Rays end at 75 degrees: the sides are met 70.7 / tan 75 = 19 mm in front of the edge.
  EXPECT_NEAR(row["width_mm"].get<double>(), 100 * std::sqrt(2), 0.1);
  EXPECT_EQ(row["compared"], 51);
  EXPECT_NEAR(row["volume_ml"].get<double>(), 480, 1e-6);  // 100 x 60 x 80 mm, squeezing keeps it
  EXPECT_NEAR(row["population_depth_mm"].get<double>(), 79.7, 0.5);
  EXPECT_NEAR(row["depth_ratio"].get<double>(), 60 * std::sqrt(2) / 79.7, 0.01);
  EXPECT_NEAR(row["medial_deeper"].get<double>(), 0, 1e-3);
}

TEST_F(Outlines, SaysHowMuchDeeperTheMedialHalfIs) {
  const double half = 100 * std::sqrt(2) / 2, depth = 60 * std::sqrt(2);
  const nlohmann::json row = outline_row(pressed_box(0.2), population());
  EXPECT_NEAR(row["medial_deeper"].get<double>(), 0.2 * half / depth, 0.01);
}

class PressedView : public ScratchFolder {};

TEST_F(PressedView, FiguresAreThoseOfItsSidecarOrNone) {
  write("cc.vtu.json",
        R"({"status": "look", "quality": {"force_N": 90, "contact_area_cm2": 60,
            "retained_fraction": 0.8}})");
  nlohmann::json row;
  add_press(folder_ / "cc.vtu", row);
  EXPECT_EQ(row, nlohmann::json({{"press_status", "look"},
                                 {"force_N", 90},
                                 {"pressure_kpa", 15.0},
                                 {"retained_fraction", 0.8}}));
  add_press(folder_ / "mlo.vtu", row);
  for (const auto& [key, value] : row.items()) EXPECT_TRUE(value.is_null()) << key;
}

}  // namespace
}  // namespace mammotwin
