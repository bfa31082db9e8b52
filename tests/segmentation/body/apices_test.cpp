#include "segmentation/body/apices.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace mammotwin {
namespace {

/// Two bumps of 40 and 30 mm at -70 and 80 mm on a flat chest, 2 mm columns from -150 mm.
std::vector<double> two_bumps(double second = 30) {
  std::vector<double> front;
  for (int i = 0; i <= 150; ++i) {
    const double x = -150 + 2 * i;
    const auto bump = [&](double c, double h) {
      return h * std::max(0.0, 1 - std::pow((x - c) / 50, 2));
    };
    front.push_back(bump(-70, 40) + bump(80, second));
  }
  return front;
}

TEST(Apices, AreTheBumpsAndTheMiddleOfThePlateauBetween) {
  const auto apices = find_apices(two_bumps(), 2);
  ASSERT_TRUE(apices);
  EXPECT_EQ(apices->right, 40);
  EXPECT_EQ(apices->left, 115);
  // The floor is flat from -20 to 30 mm, and 2 mm up the bumps: its middle is near 5 mm.
  EXPECT_NEAR(-150 + 2 * apices->valley, 5, 2);
}

TEST(Apices, OfAMirroredProfileAreTheMirrorImages) {
  std::vector<double> front = two_bumps();
  front.pop_back();  // an even number of columns
  const auto apices = find_apices(front, 2);
  std::reverse(front.begin(), front.end());
  const auto mirrored = find_apices(front, 2);
  ASSERT_TRUE(apices && mirrored);
  const auto last = static_cast<double>(front.size() - 1);
  EXPECT_EQ(mirrored->right, last - apices->left);
  EXPECT_EQ(mirrored->left, last - apices->right);
  EXPECT_DOUBLE_EQ(mirrored->valley, last - apices->valley);
  EXPECT_DOUBLE_EQ(valley_between({5, 0, 0, 5}, 0, 3), 1.5);
}

/// As where a coil's plates pressed one breast and not the other: the skin falls towards it.
TEST(Apices, HaveAPlaceNearTheMiddleForAValleyAtTheFootOfOneOfThem) {
  std::vector<double> front;
  for (int i = 0; i <= 150; ++i)
    front.push_back(std::max(
        {40 - 0.05 * (i - 40) * (i - 40), 30 - 0.2 * (i - 125) * (i - 125), 0.2 * (110 - i), 0.0}));
  EXPECT_GT(valley_between(front, 40, 125), 101) << "beyond two thirds";
  const auto apices = find_apices(front, 2);
  ASSERT_TRUE(apices);
  EXPECT_EQ(apices->right, 40);
  EXPECT_EQ(apices->left, 125);
  EXPECT_LT(apices->valley, 95);
  EXPECT_GE(apices->valley, 82.5);
}

/// The cleft comes back from where it is a third's end as the valley goes on from there.
TEST(Apices, HaveACleftThatDoesNotLeap) {
  const auto cleft_of = [](int valley) {
    std::vector<double> front(121, 10);
    front[0] = front[120] = 60;
    front[valley] = 0;
    return cleft_between(front, 0, 120);
  };
  EXPECT_EQ(cleft_of(75), 75);
  EXPECT_EQ(cleft_of(80), 80);
  EXPECT_EQ(cleft_of(81), 79);
  EXPECT_EQ(cleft_of(95), 65);
  EXPECT_EQ(cleft_of(115), 60);
  EXPECT_EQ(cleft_of(39), 41);
}

TEST(Apices, KeepTheirValleyWhereTheMiddleIsBreast) {
  std::vector<double> front;
  for (int i = 0; i <= 150; ++i)
    front.push_back(
        std::max({40 - 0.008 * (i - 40) * (i - 40), 30 - 0.2 * (i - 125) * (i - 125), 0.0}));
  const auto apices = find_apices(front, 2);
  ASSERT_TRUE(apices);
  EXPECT_GT(apices->valley, 105);
}

TEST(Apices, OfABreastAndAnArmAreNone) {
  std::vector<double> front(150, 0);
  front[20] = 30, front[60] = 40;  // of 149: the middle between them at 0.27, the valley before it
  for (int i = 21; i < 60; ++i) front[i] = 0.1 * i;
  EXPECT_FALSE(find_apices(front, 2));
}

TEST(Apices, OneBreastHasNoValley) { EXPECT_FALSE(find_apices(two_bumps(0), 2)); }

TEST(Apices, ALowSecondBumpIsNoBreast) { EXPECT_FALSE(find_apices(two_bumps(8), 2)); }

TEST(Apices, NothingAtAllIsNoBreast) {
  EXPECT_FALSE(find_apices({}, 2));
  EXPECT_FALSE(find_apices(std::vector<double>(50, -INFINITY), 2));
}

}  // namespace
}  // namespace mammotwin
