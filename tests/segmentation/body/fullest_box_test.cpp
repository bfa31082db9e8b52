#include "segmentation/body/fullest_box.h"

#include <gtest/gtest.h>

#include <random>

namespace mammotwin {
namespace {

constexpr int nx = 9, nz = 8, apex_i = 4, apex_k = 3;

TissueColumns random_columns(int seed) {
  TissueColumns columns{nx, nz, {}, {}, {}};
  std::mt19937 random(seed);
  for (int n = 0; n < nx * nz; ++n)
    columns.tissue.push_back(random() % 6 == 0 ? 3 : random() % 3 == 0 ? 6 : 20 + random() % 30);
  columns.tissue[columns.at(apex_i, apex_k)] = 60;
  columns.front.assign(nx * nz, 0);
  return columns;
}

/// The same by looking at every box.
double most_by_hand(const TissueColumns& columns, const FullestBoxRules& rules) {
  double most = 0;
  for (int i0 = 0; i0 <= apex_i; ++i0)
    for (int i1 = apex_i; i1 < nx; ++i1)
      for (int k0 = 0; k0 <= apex_k; ++k0)
        for (int k1 = apex_k; k1 < nz; ++k1) {
          double sum = 0;
          bool rich = true;
          for (int k = k0; k <= k1; ++k)
            for (int i = i0; i <= i1; ++i) {
              const double tissue = columns.tissue[columns.at(i, k)];
              const int lateral = rules.side == Side::left ? i1 : i0;
              const bool edge = i == lateral && i != apex_i;
              rich = rich && tissue >= (edge ? rules.least_lateral_mm : rules.least_mm);
              sum += tissue;
            }
          if (rich) most = std::max(most, sum);
        }
  return most;
}

TEST(FullestBox, HoldsAsMuchAsTheBestOfAllBoxes) {
  for (int seed = 0; seed < 40; ++seed) {
    const TissueColumns columns = random_columns(seed);
    const FullestBoxRules rules{seed % 2 ? Side::left : Side::right};
    const ColumnBox box =
        fullest_box(columns, columns.tissue, {0, nx - 1, 0, nz - 1}, apex_i, apex_k, rules);
    ASSERT_TRUE(box.contains(apex_i, apex_k));
    double sum = 0;
    for (int k = box.k0; k <= box.k1; ++k)
      for (int i = box.i0; i <= box.i1; ++i) {
        sum += columns.tissue[columns.at(i, k)];
        EXPECT_GE(columns.tissue[columns.at(i, k)], rules.least_mm);
      }
    EXPECT_DOUBLE_EQ(sum, most_by_hand(columns, rules)) << "seed " << seed;
  }
}

TEST(FullestBox, StaysWithinItsBounds) {
  TissueColumns columns = random_columns(1);
  columns.tissue.assign(nx * nz, 30);
  const ColumnBox box = fullest_box(columns, columns.tissue, {2, 6, 1, 5}, apex_i, apex_k, {});
  EXPECT_EQ(box.i0, 2);
  EXPECT_EQ(box.i1, 6);
  EXPECT_EQ(box.k0, 1);
  EXPECT_EQ(box.k1, 5);
}

}  // namespace
}  // namespace mammotwin
