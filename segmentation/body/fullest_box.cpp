#include "segmentation/body/fullest_box.h"

#include <algorithm>

namespace mammotwin {
namespace {

/// Rows of columns between a lower and an upper edge, summed up row by row.
class SummedRows {
 public:
  SummedRows(const TissueColumns& columns, const std::vector<double>& worth,
             const FullestBoxRules& rules)
      : columns_(columns), worth_(worth), rules_(rules), sums_(columns.nx) {}

  void add(int k) {
    for (int i = 0; i < columns_.nx; ++i) {
      const std::size_t n = columns_.at(i, k);
      const double missing = std::max(0.0, rules_.least_mm - columns_.tissue[n]);
      sums_[i].worth += worth_[n] - rules_.cost_of_missing * missing;
      sums_[i].empty |= missing > 0 && !columns_.on_muscle[n];
      sums_[i].thin |= columns_.tissue[n] < rules_.least_lateral_mm;
    }
  }

  bool holds(int i) const { return !sums_[i].empty; }
  double worth(int i) const { return sums_[i].worth; }

  struct Side {
    int end;
    double worth;
  };
  /// From beside column `i` on, to `last` at most, the columns that are worth most together.
  Side best_side(int i, int last, bool lateral) const {
    const int step = last < i ? -1 : 1;
    Side best{i, 0};
    double worth = 0;
    for (int at = i; at != last && holds(at + step);) {
      at += step;
      worth += sums_[at].worth;
      if (worth > best.worth && !(lateral && sums_[at].thin)) best = {at, worth};
    }
    return best;
  }

 private:
  struct Sum {
    double worth = 0;
    bool empty = false;  ///< one of them has too little tissue and no muscle
    bool thin = false;   ///< one of them is too thin for the lateral edge
  };
  const TissueColumns& columns_;
  const std::vector<double>& worth_;
  const FullestBoxRules& rules_;
  std::vector<Sum> sums_;
};

}  // namespace

ColumnBox fullest_box(const TissueColumns& columns, const std::vector<double>& worth,
                      const ColumnBox& within, int i, int k, const FullestBoxRules& rules) {
  ColumnBox best{i, i, k, k};
  double most = -1;
  SummedRows lower(columns, worth, rules);
  for (int k0 = k; k0 >= within.k0; --k0) {
    lower.add(k0);
    if (!lower.holds(i)) break;
    SummedRows rows = lower;
    for (int k1 = k; k1 <= within.k1; ++k1) {
      if (k1 > k) rows.add(k1);
      if (!rows.holds(i)) break;
      const auto right = rows.best_side(i, within.i0, rules.side == Side::right);
      const auto left = rows.best_side(i, within.i1, rules.side == Side::left);
      const double sum = rows.worth(i) + right.worth + left.worth;
      if (sum > most) most = sum, best = {right.end, left.end, k0, k1};
    }
  }
  return best;
}

}  // namespace mammotwin
