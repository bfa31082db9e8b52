#include "segmentation/body/fullest_box.h"

#include <algorithm>

namespace mammotwin {
namespace {

/// Sums over boxes of columns in constant time.
class BoxSums {
 public:
  BoxSums(const std::vector<double>& values, int nx, int nz)
      : nx_(nx + 1), sum_(static_cast<std::size_t>(nx + 1) * (nz + 1), 0) {
    for (int k = 0; k < nz; ++k)
      for (int i = 0; i < nx; ++i)
        sum_[at(i + 1, k + 1)] = values[static_cast<std::size_t>(k) * nx + i] + sum_[at(i, k + 1)] +
                                 sum_[at(i + 1, k)] - sum_[at(i, k)];
  }
  double operator()(const ColumnBox& b) const {
    return sum_[at(b.i1 + 1, b.k1 + 1)] - sum_[at(b.i0, b.k1 + 1)] - sum_[at(b.i1 + 1, b.k0)] +
           sum_[at(b.i0, b.k0)];
  }

 private:
  std::size_t at(int i, int k) const { return static_cast<std::size_t>(k) * nx_ + i; }
  int nx_;
  std::vector<double> sum_;
};

/// 1 where a column has less tissue than that.
std::vector<double> poorer_than(const TissueColumns& columns, double least_mm) {
  std::vector<double> poor;
  for (const double tissue : columns.tissue) poor.push_back(tissue < least_mm);
  return poor;
}

/// How far one row reaches from column i without a poor one.
void narrow(const TissueColumns& columns, int k, int i, double least_mm, ColumnBox& box) {
  int low = i, high = i;
  while (low > box.i0 && columns.tissue[columns.at(low - 1, k)] >= least_mm) --low;
  while (high < box.i1 && columns.tissue[columns.at(high + 1, k)] >= least_mm) ++high;
  box.i0 = low, box.i1 = high;
}

}  // namespace

ColumnBox fullest_box(const TissueColumns& columns, const std::vector<double>& worth,
                      const ColumnBox& within, int i, int k, const FullestBoxRules& rules) {
  const BoxSums worths(worth, columns.nx, columns.nz);
  const BoxSums thin(poorer_than(columns, rules.least_lateral_mm), columns.nx, columns.nz);
  const auto rich = [&](int row) { return columns.tissue[columns.at(i, row)] >= rules.least_mm; };
  const auto lateral_edge = [&](ColumnBox box) {
    int& edge = rules.side == Side::left ? box.i1 : box.i0;
    const int inward = rules.side == Side::left ? -1 : 1;
    while (edge != i && thin({edge, edge, box.k0, box.k1}) > 0) edge += inward;
    return box;
  };
  ColumnBox best{i, i, k, k};
  double most = -1;
  ColumnBox lower{within.i0, within.i1, k, k};
  for (int k0 = k; k0 >= within.k0 && rich(k0); --k0) {
    narrow(columns, lower.k0 = k0, i, rules.least_mm, lower);
    ColumnBox box = lower;
    for (int k1 = k; k1 <= within.k1 && rich(k1); ++k1) {
      narrow(columns, box.k1 = k1, i, rules.least_mm, box);
      const ColumnBox edged = lateral_edge(box);
      if (const double sum = worths(edged); sum > most) most = sum, best = edged;
    }
  }
  return best;
}

}  // namespace mammotwin
