#include "registration/export/markups.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>

#include "tests/scratch_file.h"

namespace mammotwin {
namespace {

TEST(Markups, ComeBackAsTheyWereWritten) {
  const auto path = scratch_file("points.mrk.json");
  write_markups(path, {{"lesion 1", {12.25, -3.5, 1.0 / 3}}, {"nipple", {0, -60, 0}}});
  const auto points = read_markups(path);
  ASSERT_EQ(points.size(), 2u);
  EXPECT_EQ(points[0].label, "lesion 1");
  EXPECT_EQ(points[0].x_in_lps, Eigen::Vector3d(12.25, -3.5, 1.0 / 3));
}

TEST(Markups, SayTheirFrameUnitAndSchema) {
  const auto path = scratch_file("frame.mrk.json");
  write_markups(path, {{"1", {1, 2, 3}}});
  const auto file = nlohmann::json::parse(std::ifstream(path));
  EXPECT_NE(file.at("@schema").get<std::string>().find("markups-schema-v1.0.3.json#"),
            std::string::npos);
  EXPECT_EQ(file["markups"][0]["type"], "Fiducial");
  EXPECT_EQ(file["markups"][0]["coordinateSystem"], "LPS");
  EXPECT_EQ(file["markups"][0]["coordinateUnits"], "mm");
}

TEST(Markups, ACurveIsClosedAndNamed) {
  const auto path = scratch_file("curve.mrk.json");
  write_closed_curve(path, "L1 in cc", {{1, 2, 3}, {4, 5, 6}, {7, 8, 10}});
  const auto markup = nlohmann::json::parse(std::ifstream(path)).at("markups").at(0);
  EXPECT_EQ(markup["type"], "ClosedCurve");
  EXPECT_EQ(markup["name"], "L1 in cc");
  EXPECT_EQ(markup["coordinateSystem"], "LPS");
  EXPECT_EQ(read_markups(path).at(2).x_in_lps, Eigen::Vector3d(7, 8, 10));
}

// Whatever a name holds, the file is JSON in which it comes back as it was.
TEST(Markups, KeepHostileNamesAsText) {
  for (const std::string id : {"</script><b>&\"'", "=cmd|' /C calc'!A0", "a\nb\t\x1b[31m",
                               "\",\"position\":[0,0,0],\"x\":\"", "\u202egnp.1L", "a\\u0022b"}) {
    SCOPED_TRACE(id);
    const auto points = scratch_file("hostile.mrk.json"), curve = scratch_file("curve.mrk.json");
    write_markups(points, {{id, {1, 2, 3}, id}});
    const auto read = read_markups(points);
    ASSERT_EQ(read.size(), 1u);
    EXPECT_EQ(read[0].label, id);
    EXPECT_EQ(read[0].description, id);
    EXPECT_EQ(read[0].x_in_lps, Eigen::Vector3d(1, 2, 3));
    write_closed_curve(curve, id, {{1, 2, 3}, {4, 5, 6}, {7, 8, 10}});
    EXPECT_EQ(nlohmann::json::parse(std::ifstream(curve)).at("markups").at(0)["name"], id);
  }
}

/// Types of 3D Slicer's schema of markups (version 1.0.3), of what may stand in each object.
using Types = std::map<std::string, std::string>;
const Types kMarkup = {{"type", "Fiducial|Line|Angle|Curve|ClosedCurve|Plane|ROI"},
                       {"name", "string"},
                       {"coordinateSystem", "LPS|RAS"},
                       {"coordinateUnits", "mm|um"},
                       {"locked", "boolean"},
                       {"labelFormat", "string"},
                       {"controlPoints", "objects"}};
const Types kControlPoint = {
    {"id", "string"},          {"label", "string"},
    {"description", "string"}, {"associatedNodeID", "string"},
    {"position", "3"},         {"orientation", "9"},
    {"selected", "boolean"},   {"locked", "boolean"},
    {"visibility", "boolean"}, {"positionStatus", "undefined|preview|defined"}};

bool is(const nlohmann::json& value, const std::string& type) {
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "objects") return value.is_array();
  if (type == "3" || type == "9")
    return value.is_array() && value.size() == std::stoul(type) &&
           std::all_of(value.begin(), value.end(), [](const auto& v) { return v.is_number(); });
  if (!value.is_string()) return false;
  return ("|" + type + "|").find("|" + value.get<std::string>() + "|") != std::string::npos;
}

void expect_types(const nlohmann::json& object, const Types& types) {
  for (const auto& [key, value] : object.items()) {
    ASSERT_TRUE(types.count(key)) << key;
    EXPECT_TRUE(is(value, types.at(key))) << key << " is " << value;
  }
}

TEST(Markups, HaveTheTypesOfSlicersSchema) {
  const auto points = scratch_file("points.mrk.json"), curve = scratch_file("curve.mrk.json");
  write_markups(points, {{"1", {1, 2, 3}}, {"nipple", {0, -60, 0}}});
  write_closed_curve(curve, "L1 in cc", {{1, 2, 3}, {4, 5, 6}, {7, 8, 10}});
  for (const auto& path : {points, curve}) {
    const auto file = nlohmann::json::parse(std::ifstream(path));
    EXPECT_TRUE(file.at("@schema").is_string());
    for (const auto& markup : file.at("markups")) {
      EXPECT_TRUE(markup.contains("type"));
      expect_types(markup, kMarkup);
      for (const auto& point : markup.at("controlPoints")) expect_types(point, kControlPoint);
    }
  }
}

}  // namespace
}  // namespace mammotwin
