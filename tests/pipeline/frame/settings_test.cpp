#include "pipeline/frame/settings.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

namespace mammotwin {
namespace {

class SettingsTest : public testing::Test {
 protected:
  enum class Color { red, green };

  SettingsTest() {
    settings_.number("thickness_mm", thickness_, {20, 120, "mm", "is it in cm?"}, "plates' gap");
    settings_.integers("elements", elements_, {1, 32}, "elements a direction");
    settings_.choice("color", color_, {{"red", Color::red}, {"green", Color::green}}, "colour");
    settings_.flag("on", on_, "switch");
    settings_.point("point_mm", point_, {-1000, 1000, "mm"}, "a point");
  }

  std::string message_of(const std::string& key, const nlohmann::json& value) {
    try {
      settings_.assign("file: " + key, key, value);
    } catch (const BadSetting& e) {
      return e.what();
    }
    return {};
  }

  std::optional<double> thickness_;
  std::optional<Eigen::Vector3i> elements_ = Eigen::Vector3i(6, 6, 2);
  Color color_ = Color::red;
  bool on_ = false;
  std::optional<Eigen::Vector3d> point_;
  Settings settings_;
};

TEST_F(SettingsTest, AssignValuesOfTheirType) {
  settings_.assign("", "thickness_mm", 55);
  settings_.assign("", "elements", {8, 8, 2});
  settings_.assign("", "color", "green");
  settings_.assign("", "on", true);
  EXPECT_EQ(thickness_, 55.0);
  EXPECT_EQ(elements_, Eigen::Vector3i(8, 8, 2));
  EXPECT_EQ(color_, Color::green);
  EXPECT_TRUE(on_);
}

TEST_F(SettingsTest, ReadTheSameFromText) {
  settings_.assign_text("", "thickness_mm", "55.5");
  settings_.assign_text("", "elements", "4,4,1");
  settings_.assign_text("", "point_mm", "[1, 2, 3.5]");
  settings_.assign_text("", "color", "green");
  EXPECT_EQ(thickness_, 55.5);
  EXPECT_EQ(elements_, Eigen::Vector3i(4, 4, 1));
  EXPECT_EQ(*point_, Eigen::Vector3d(1, 2, 3.5));
  EXPECT_EQ(color_, Color::green);
}

TEST_F(SettingsTest, SayFoundExpectedAndHint) {
  EXPECT_EQ(message_of("thickness_mm", 5.2),
            "file: thickness_mm is 5.2; expected 20 to 120 mm (is it in cm?)");
  EXPECT_EQ(message_of("color", "blue"), "file: color is \"blue\"; expected \"red\" or \"green\"");
}

TEST_F(SettingsTest, RefuseWrongTypes) {
  EXPECT_NE(message_of("thickness_mm", "thick"), "");
  EXPECT_NE(message_of("thickness_mm", std::nan("")), "");
  EXPECT_NE(message_of("elements", {8, 8}), "");
  EXPECT_NE(message_of("elements", {8, 8, 1.5}), "");
  EXPECT_NE(message_of("on", 1), "");
  EXPECT_NE(message_of("point_mm", {1, 2, nullptr}), "");
  EXPECT_EQ(elements_, Eigen::Vector3i(6, 6, 2)) << "a refused value must change nothing";
}

TEST_F(SettingsTest, ParametersCarryUnits) {
  settings_.assign("", "thickness_mm", 55);
  const auto parameters = settings_.parameters({"thick"});
  ASSERT_EQ(parameters.size(), 1u);
  EXPECT_EQ(parameters["thickness_mm"]["value"], 55.0);
  EXPECT_EQ(parameters["thickness_mm"]["unit"], "mm");
}

TEST_F(SettingsTest, APresetLeavesWhatAUserGave) {
  std::string chosen = "cold";
  settings_.preset("preset", chosen,
                   {{"cold", {{"color", "red"}, {"thickness_mm", "40"}, {"on", "false"}}},
                    {"warm", {{"color", "green"}, {"thickness_mm", "60"}, {"on", "true"}}}},
                   "sets of values");
  settings_.assign("", "thickness_mm", 50);  // before the name
  settings_.assign("", "preset", "warm");
  EXPECT_EQ(chosen, "warm");
  EXPECT_EQ(color_, Color::green);
  EXPECT_EQ(thickness_, 50.0);
  EXPECT_TRUE(on_);
  settings_.assign_text("", "on", "true");  // after it
  settings_.assign_text("", "preset", "cold");
  EXPECT_EQ(color_, Color::red);
  EXPECT_EQ(thickness_, 50.0);
  EXPECT_TRUE(on_);
  EXPECT_EQ(settings_.parameters({"preset"})["preset"]["value"], "cold");
  EXPECT_NE(message_of("preset", "hot").find("expected \"cold\" or \"warm\""), std::string::npos);
}

}  // namespace
}  // namespace mammotwin
