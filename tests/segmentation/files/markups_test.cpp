#include "segmentation/files/markups.h"

#include <fstream>

#include "tests/segmentation/message.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

class Markups : public testing::Test {
 protected:
  fs::path write(const char* name, const std::string& text) {
    std::ofstream(folder_.path / name) << text;
    return folder_.path / name;
  }
  const EmptyFolder folder_{"markups_files"};
};

std::string roi(const char* frame, const char* orientation, const char* size = "[100, 80, 120]") {
  return std::string(R"({"markups":[{"type":"ROI","coordinateSystem":")") + frame +
         R"(","center":[-70, 30, 10],"orientation":)" + orientation + R"(,"size":)" + size + "}]}";
}

TEST_F(Markups, APointMayBeInLpsOrRas) {
  const auto with = [&](const char* name, const char* frame, const char* position) {
    return write(name, std::string(R"({"markups":[{"coordinateSystem":")") + frame +
                           R"(","controlPoints":[{"position":)" + position + "}]}]}");
  };
  const Eigen::Vector3d lps(80, 40, 5);
  EXPECT_EQ(read_markups_point(with("a.mrk.json", "LPS", "[80, 40, 5]")), lps);
  EXPECT_EQ(read_markups_point(with("b.mrk.json", "RAS", "[-80, -40, 5]")), lps);
  expect_mentions(message_of([&] { read_markups_point(with("c.mrk.json", "XYZ", "[1, 2, 3]")); }),
                  {"c.mrk.json", "XYZ", "LPS"});
  expect_mentions(message_of([&] { read_markups_point(folder_.path / "none.mrk.json"); }),
                  {"none.mrk.json", "does not exist"});
}

TEST_F(Markups, APointWithoutAPlaceIsLeftOut) {
  const auto points = read_markups(write("ras.mrk.json", R"({"markups": [{"type": "Fiducial",
      "coordinateSystem": "1",
      "controlPoints": [{"label": "F-2", "position": [0, 0, 0], "positionStatus": "undefined"},
                        {"label": "F-1", "position": [10, 20, 30], "description": "a lesion"}]}]})"));
  ASSERT_EQ(points.size(), 1U);
  EXPECT_EQ(points[0].x_in_lps, Eigen::Vector3d(-10, -20, 30));
  EXPECT_EQ(points[0].label, "F-1");
  EXPECT_EQ(points[0].description, "a lesion");
}

TEST_F(Markups, WhatIsWrongIsSaidOfTheFile) {
  const auto said_of = [&](const std::string& markup) {
    return message_of(
        [&] { read_markups(write("bad.mrk.json", "{\"markups\": [" + markup + "]}")); });
  };
  expect_mentions(said_of(R"({"type": "Fiducial"})"), {"bad.mrk.json", "controlPoints"});
  expect_mentions(said_of(R"({"coordinateUnits": "cm", "controlPoints": []})"),
                  {"cm", "expected mm"});
  expect_mentions(said_of(R"({"controlPoints": [{"position": [1, 2]}]})"),
                  {"2 numbers", "expected 3"});
  expect_mentions(said_of(R"({"controlPoints": []})"), {"no control point"});
}

TEST_F(Markups, PointsOfAllListsAndCurvesAreTaken) {
  const auto points = read_markups_points(write("wall.mrk.json", R"({"markups":[
    {"type":"Curve","coordinateSystem":"RAS","controlPoints":[{"position":[-1,-2,3]},{"position":[-4,-5,6]}]},
    {"type":"Fiducial","coordinateSystem":"LPS","controlPoints":[{"position":[7,8,9]}]}]})"));
  ASSERT_EQ(points.size(), 3u);
  EXPECT_EQ(points[1], Eigen::Vector3d(4, 5, 6));
  EXPECT_EQ(points[2], Eigen::Vector3d(7, 8, 9));
  expect_mentions(
      message_of([&] {
        read_markups_points(write("none.mrk.json", R"({"markups":[{"controlPoints":[]}]})"));
      }),
      {"none.mrk.json", "no control point"});
}

TEST_F(Markups, ABoxIsAnRoiAlongTheAxes) {
  const char* along = "[-1,0,0, 0,-1,0, 0,0,1]";
  const Eigen::AlignedBox3d box = read_markups_box(write("roi.mrk.json", roi("RAS", along)));
  EXPECT_EQ(box.min(), Eigen::Vector3d(20, -70, -50));
  EXPECT_EQ(box.max(), Eigen::Vector3d(120, 10, 70));
  expect_mentions(
      message_of([&] {
        read_markups_box(write("turned.mrk.json", roi("LPS", "[0.9,0.44,0, -0.44,0.9,0, 0,0,1]")));
      }),
      {"turned.mrk.json", "turned", "axes"});
  expect_mentions(message_of([&] {
                    read_markups_box(write("flat.mrk.json", roi("LPS", along, "[100, 0, 120]")));
                  }),
                  {"flat.mrk.json", "flat"});
  expect_mentions(
      message_of([&] { read_markups_box(write("list.mrk.json", R"({"markups":[{}]})")); }),
      {"list.mrk.json", "ROI"});
}

}  // namespace
}  // namespace mammotwin
