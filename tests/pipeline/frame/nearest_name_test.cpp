#include "pipeline/frame/nearest_name.h"

#include <gtest/gtest.h>

namespace mammotwin {
namespace {

TEST(NearestName, TakesTheFewestEdits) {
  const std::vector<std::string> keys{"views.cc.thickness_mm", "views.mlo.thickness_mm", "side"};
  EXPECT_EQ(nearest_name("views.cc.thicknes_mm", keys), "views.cc.thickness_mm");
  EXPECT_EQ(nearest_name("views.ml.thickness_mm", keys), "views.mlo.thickness_mm");
  EXPECT_EQ(nearest_name("sied", keys), "side");
}

TEST(NearestName, CountsASwapOfNeighboursAsOneEdit) {
  // "abdc" is one swap from "abcd" and two replacements from "abzz".
  EXPECT_EQ(nearest_name("abdc", {"abzz", "abcd"}), "abcd");
}

}  // namespace
}  // namespace mammotwin
