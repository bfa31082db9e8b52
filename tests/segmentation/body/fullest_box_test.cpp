#include "segmentation/body/fullest_box.h"

#include <gtest/gtest.h>

#include <optional>
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
  for (int n = 0; n < nx * nz; ++n) columns.on_muscle.push_back(random() % 2);
  return columns;
}

/// Tissue less what is missing on muscle; none where that cannot be set back.
std::optional<double> sum_of(const TissueColumns& columns, const ColumnBox& box,
                             const FullestBoxRules& rules) {
  double sum = 0;
  const int lateral = rules.side == Side::left ? box.i1 : box.i0;
  for (int k = box.k0; k <= box.k1; ++k)
    for (int i = box.i0; i <= box.i1; ++i) {
      const double tissue = columns.tissue[columns.at(i, k)];
      const double missing = std::max(0.0, rules.least_mm - tissue);
      if (missing > 0 && !columns.on_muscle[columns.at(i, k)]) return {};
      if (i == lateral && i != apex_i && tissue < rules.least_lateral_mm) return {};
      sum += tissue - rules.cost_of_missing * missing;
    }
  return sum;
}

/// The same by looking at every box.
double most_by_hand(const TissueColumns& columns, const FullestBoxRules& rules) {
  double most = 0;
  for (int i0 = 0; i0 <= apex_i; ++i0)
    for (int i1 = apex_i; i1 < nx; ++i1)
      for (int k0 = 0; k0 <= apex_k; ++k0)
        for (int k1 = apex_k; k1 < nz; ++k1)
          most = std::max(most, sum_of(columns, {i0, i1, k0, k1}, rules).value_or(0));
  return most;
}

TEST(FullestBox, HoldsAsMuchAsTheBestOfAllBoxes) {
  for (int seed = 0; seed < 40; ++seed) {
    const TissueColumns columns = random_columns(seed);
    for (const double cost : {1.0, 6.0, 100.0}) {
      FullestBoxRules rules{seed % 2 ? Side::left : Side::right};
      rules.cost_of_missing = cost;
      const ColumnBox box =
          fullest_box(columns, columns.tissue, {0, nx - 1, 0, nz - 1}, apex_i, apex_k, rules);
      ASSERT_TRUE(box.contains(apex_i, apex_k));
      EXPECT_DOUBLE_EQ(sum_of(columns, box, rules).value(), most_by_hand(columns, rules))
          << "seed " << seed << " cost " << cost;
    }
  }
}

TEST(FullestBox, AThinColumnOnMuscleCostsLessThanWhatLiesBehindIt) {
  TissueColumns columns{nx, nz, {}, {}, {}};
  columns.tissue.assign(nx * nz, 20);
  columns.on_muscle.assign(nx * nz, 1);
  columns.front.assign(nx * nz, 0);
  const ColumnBox all{0, nx - 1, 0, nz - 1};
  columns.tissue[columns.at(2, 5)] = 3;
  ColumnBox box = fullest_box(columns, columns.tissue, all, apex_i, apex_k, {});
  EXPECT_TRUE(box.contains(2, 5)) << "12 given up for two columns of 20 and more";
  columns.on_muscle[columns.at(2, 5)] = 0;
  box = fullest_box(columns, columns.tissue, all, apex_i, apex_k, {});
  EXPECT_FALSE(box.contains(2, 5)) << "no muscle that could be set back";
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
