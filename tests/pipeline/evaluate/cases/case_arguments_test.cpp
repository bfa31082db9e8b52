#include "pipeline/evaluate/cases/case_arguments.h"

#include <gtest/gtest.h>

#include "pipeline/evaluate/cases/real_breasts.h"

namespace mammotwin {
namespace {

TEST(CaseArguments, BreastsAreAskedForByAnyPartOfNameAndSide) {
  const std::string name = name_and_side({"Exam_02", Side::left, ""});
  EXPECT_EQ(name, "Exam_02-left");
  EXPECT_TRUE(is_asked(name, {}));
  EXPECT_TRUE(is_asked(name, {"Exam_04", "02-left"}));
  EXPECT_FALSE(is_asked(name, {"Exam_04", "right"}));
}

}  // namespace
}  // namespace mammotwin
