#include "pipeline/evaluate/cases/real_breasts.h"

#include <gtest/gtest.h>

namespace mammotwin {
namespace {

TEST(RealBreasts, AreAskedForByAnyPartOfNameAndSide) {
  const std::string name = name_and_side({"Exam_02", Side::left, ""});
  EXPECT_EQ(name, "Exam_02-left");
  EXPECT_TRUE(is_asked(name, {}));
  EXPECT_TRUE(is_asked(name, {"Exam_04", "02-left"}));
  EXPECT_FALSE(is_asked(name, {"Exam_04", "right"}));
}

}  // namespace
}  // namespace mammotwin
