#include "pipeline/evaluate/registration/stranger_rows.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/scratch_file.h"

namespace mammotwin {
namespace {

ReadMammogram shown(const std::string& file, const std::string& view, double pixel_mm,
                    bool wall_at_left) {
  ReadMammogram read;
  read.file = file, read.view = view, read.pixel_mm = pixel_mm, read.wall_at_left = wall_at_left;
  return read;
}

TEST(StrangersExams, AreOfTheBreastsEdgeAndOfEqualPixels) {
  const std::vector<ReadMammogram> all{
      shown("c1", "cc", 0.1, true),  shown("c2", "cc", 0.1, false), shown("c3", "cc", 0.05, true),
      shown("c4", "cc", 0.1, true),  shown("c5", "cc", 0.1, true),  shown("m1", "mlo", 0.1, false),
      shown("m2", "mlo", 0.1, true), shown("m3", "mlo", 0.1, true)};
  const auto left = strangers_exams(all, Side::left);
  ASSERT_EQ(left.size(), 2u) << "no MLO of 0.05 mm, and only two at the left";
  EXPECT_EQ(left[0].cc.file, "c1");
  EXPECT_EQ(left[0].mlo.file, "m2");
  EXPECT_EQ(left[1].cc.file, "c4");
  EXPECT_EQ(left[1].mlo.file, "m3");
  const auto right = strangers_exams(all, Side::right);
  ASSERT_EQ(right.size(), 1u);
  EXPECT_EQ(right[0].cc.file, "c2");
  EXPECT_EQ(right[0].mlo.file, "m1");
}

TEST(StrangerRows, SayWhyABreastCouldNotBePressed) {
  RealBreast breast;
  breast.name = "nobody", breast.image = "/nowhere/labels.nii.gz";
  std::vector<nlohmann::json> rows;
  add_stranger_rows(breast, {StrangersExam{}}, scratch_file("nobody"),
                    [&](const nlohmann::json& row) { rows.push_back(row); });
  ASSERT_EQ(rows.size(), 1u) << "no exam is tried";
  EXPECT_EQ(rows[0].at("name"), "nobody");
  const std::string reason = rows[0].at("reason");
  EXPECT_NE(reason.find("/nowhere/labels.nii.gz"), std::string::npos) << reason;
}

}  // namespace
}  // namespace mammotwin
