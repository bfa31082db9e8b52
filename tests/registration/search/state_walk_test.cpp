#include "registration/search/state_walk.h"

#include <gtest/gtest.h>

#include <vector>

namespace mammotwin {
namespace {

/// Solves that succeed only within `reach` of where they start and not beyond `wall`; where a
/// solution stands is kept in its thickness.
struct Ground {
  double reach, wall;
  std::vector<double> tried{};

  std::optional<SolvedView> solve(const SolvedView& near, double share) {
    tried.push_back(share);
    if (share - near.view.thickness_mm > reach || share > wall) return std::nullopt;
    SolvedView there;
    there.view.thickness_mm = share;
    return there;
  }
  Walk walk(double shortest) {
    SolvedView start;
    start.view.thickness_mm = 0;
    return mammotwin::walk(start, shortest, [this](const SolvedView& near, double share) {
      return solve(near, share);
    });
  }
};

TEST(StateWalk, GoesAtOnceWhereItCan) {
  Ground ground{1, 1};
  EXPECT_EQ(ground.walk(0.125).share, 1);
  EXPECT_EQ(ground.tried, std::vector<double>{1});
}

TEST(StateWalk, HalvesStepsAndStartsEachFromTheOneBefore) {
  Ground ground{0.3, 1};
  const Walk walk = ground.walk(0.125);
  EXPECT_EQ(walk.share, 1);
  EXPECT_EQ(walk.end.view.thickness_mm, 1);
  EXPECT_EQ(ground.tried, (std::vector<double>{1, 0.5, 0.25, 0.5, 0.75, 1}));
}

TEST(StateWalk, EndsWhereNothingIsFoundAnyMore) {
  Ground ground{1, 0.7};
  const Walk walk = ground.walk(0.125);
  EXPECT_EQ(walk.share, 0.625);
  EXPECT_EQ(walk.end.view.thickness_mm, 0.625);
  EXPECT_EQ(ground.tried, (std::vector<double>{1, 0.5, 1, 0.75, 0.625, 0.75}));
}

TEST(StateWalk, StaysWhereItIsIfNoStepSucceeds) {
  Ground ground{0.1, 1};
  EXPECT_EQ(ground.walk(0.125).share, 0);
}

}  // namespace
}  // namespace mammotwin
