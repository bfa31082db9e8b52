#include "registration/mammogram/detector_counts.h"

#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

#include "registration/mammogram/breast_mask.h"
#include "segmentation/image/order_statistics.h"

namespace mammotwin {
namespace {

constexpr int kStride = 8;  // of the pixels that are enough for statistics

/// In double precision: levels are subtracted from one another.
double level(std::vector<float>& values, double share) { return quantile(values, share); }

/// Every stride-th pixel of every stride-th row.
MammogramImage sparse(const MammogramImage& image) {
  MammogramImage few{
      (image.columns + kStride - 1) / kStride, (image.rows + kStride - 1) / kStride, {}};
  for (int row = 0; row < image.rows; row += kStride)
    for (int column = 0; column < image.columns; column += kStride)
      few.grey.push_back(image.at(column, row));
  return few;
}

/// Values against the open field's, in nepers (of logarithms, in what they are stored in).
MammogramImage absorption(MammogramImage image, const CountsEncoding& encoding,
                          bool brighter_is_more) {
  constexpr double kOpen = 0.999, kFloor = 5e-4;  // of the open field: darker is not told apart
  const double scale =
      encoding.full_scale.value_or(*std::max_element(image.grey.begin(), image.grey.end()));
  if (!brighter_is_more)
    for (float& grey : image.grey) grey = static_cast<float>(scale - grey);
  std::vector<float> values = sparse(image).grey;
  const double open = std::max(1., level(values, kOpen));
  for (float& grey : image.grey) {
    const double counts = std::clamp<double>(grey, 0, open);
    grey = static_cast<float>(encoding.logarithmic
                                  ? open - counts
                                  : std::log((open + kFloor * open) / (counts + kFloor * open)));
  }
  return image;
}

/// A tenth of each column absorbs no more than this; or of each row.
std::vector<double> clearest(const MammogramImage& image, bool columns) {
  constexpr double kTenth = 0.1;
  const int lines = columns ? image.columns : image.rows;
  const int length = columns ? image.rows : image.columns;
  std::vector<double> clear(lines);
  std::vector<float> line;
  for (int l = 0; l < lines; ++l) {
    line.clear();
    for (int i = 0; i < length; i += kStride)
      line.push_back(columns ? image.at(l, i) : image.at(i, l));
    clear[l] = level(line, kTenth);
  }
  return clear;
}

/// How many lines from the first on a collimator covers, its shadow's edge included: dark over all
/// of their length, as no breast is, up to a step.
int covered_lines(const std::vector<double>& clear, double dark) {
  constexpr double kMost = 0.35, kStep = 0.02, kShadow = 0.02;  // of all lines
  constexpr double kNearlyDark = 0.75, kLess = 0.2;             // of what is dark; of it, a step
  const int size = static_cast<int>(clear.size());
  const int step = std::max(1, static_cast<int>(kStep * size));
  int n = 0;
  while (n < size && clear[n] >= kNearlyDark * dark) ++n;
  if (n == 0 || n > kMost * size || clear[n + step] > clear[n - 1] - kLess * dark) return 0;
  // The shadow's edge is left where the next lines are no clearer by much.
  constexpr double kFlat = 0.004;
  const int last = n + static_cast<int>(kShadow * size);
  const int ahead = std::max(1, step / 8);
  while (n < last && clear[n] - clear[n + ahead] > kFlat * dark) ++n;
  return n;
}

/// What a collimator leaves open: all of the image where nothing is as dark as behind one.
ExposedField exposed_field(const MammogramImage& image, const CountsEncoding& encoding) {
  // Breasts absorb less all along a line: 1 % of the open field is left; or in shares of the scale.
  constexpr double kDark = 4.5, kDarkShare = 0.45;
  std::vector<double> columns = clearest(image, true), rows = clearest(image, false);
  const double dark = std::max(*std::max_element(columns.begin(), columns.end()),
                               *std::max_element(rows.begin(), rows.end()));
  ExposedField field{0, image.columns - 1, 0, image.rows - 1};
  if (dark < (encoding.logarithmic ? kDarkShare * encoding.full_scale.value_or(dark) : kDark))
    return field;
  field.first_column = covered_lines(columns, dark);
  field.first_row = covered_lines(rows, dark);
  std::reverse(columns.begin(), columns.end());
  std::reverse(rows.begin(), rows.end());
  field.last_column -= covered_lines(columns, dark);
  field.last_row -= covered_lines(rows, dark);
  return field;
}

/// How much like a breast before air it looks: of the bands a tenth of the field from either side
/// air's varies less, and the other absorbs more than it by many times that.
double likeness(const MammogramImage& image, const ExposedField& f) {
  constexpr double kFirst = 0.1, kLast = 0.2, kLow = 0.1, kHigh = 0.9;
  const int wide = f.last_column - f.first_column;
  std::vector<float> left, right;
  for (int row = f.first_row; row <= f.last_row; row += kStride)
    for (int i = static_cast<int>(kFirst * wide); i <= kLast * wide; i += kStride) {
      left.push_back(image.at(f.first_column + i, row));
      right.push_back(image.at(f.last_column - i, row));
    }
  const auto width = [](std::vector<float>& band) {
    return level(band, kHigh) - level(band, kLow);
  };
  if (width(right) > width(left)) std::swap(left, right);
  const double air = level(right, 0.5);
  const double more = level(left, kHigh) - air, less = air - level(left, kLow);
  return (more - less) / std::max(1e-6, width(right));
}

/// What the collimator covers goes on as the field ends.
void repeat_border(MammogramImage& image, const ExposedField& f) {
  if (f.last_column - f.first_column + 1 == image.columns &&
      f.last_row - f.first_row + 1 == image.rows)
    return;
  for (int row = 0; row < image.rows; ++row)
    for (int column = 0; column < image.columns; ++column)
      image.at(column, row) = image.at(std::clamp(column, f.first_column, f.last_column),
                                       std::clamp(row, f.first_row, f.last_row));
}

/// A parabola over the image.
class Surface {
 public:
  static constexpr int kTerms = 6;
  using Terms = Eigen::Matrix<double, kTerms, 1>;

  Surface(int columns, int rows) : columns_(columns), rows_(rows) {}

  Terms terms(int column, int row) const {
    const double x = 2. * column / columns_ - 1, y = 2. * row / rows_ - 1;
    Terms t;
    t << 1, x, y, x * x, x * y, y * y;
    return t;
  }
  double at(int column, int row) const { return factors_.dot(terms(column, row)); }

  /// Least squares over those pixels for which `is_air` says so; `curved`, or a plane.
  template <class IsAir>
  bool fit(const MammogramImage& image, bool curved, IsAir is_air) {
    Eigen::Matrix<double, kTerms, kTerms> normal = Eigen::Matrix<double, kTerms, kTerms>::Zero();
    Terms right = Terms::Zero();
    for (int row = 0; row < image.rows; row += kStride)
      for (int column = 0; column < image.columns; column += kStride) {
        if (!is_air(column, row)) continue;
        const Terms t = terms(column, row);
        normal += t * t.transpose();
        right += t * image.at(column, row);
      }
    const double count = normal(0, 0);
    if (count < kTerms) return false;
    constexpr double kStiff = 1e-3;  // where air says nothing of a term, it is nought
    for (int i = 1; i < kTerms; ++i) normal(i, i) += (i > 2 && !curved ? 1e9 : kStiff) * count;
    factors_ = normal.ldlt().solve(right);
    return true;
  }

 private:
  int columns_, rows_;
  Terms factors_ = Terms::Zero();
};

/// Fits the open field through air: first through what is dark, a plane; then through what lies
/// within three spreads of the last fit, curved.
void take_out_heel(MammogramImage& image) {
  constexpr int kRounds = 8, kPlanes = 2;
  constexpr double kWithin = 3, kSdOfMad = 1.4826;  // of a normal distribution
  double most = 0;
  try {
    most = air_level(sparse(image), -std::numeric_limits<float>::infinity(), kSkinShare).threshold;
  } catch (const std::runtime_error&) {  // one grey: nothing to take out
    return;
  }
  Surface open(image.columns, image.rows), last = open;
  double within = std::numeric_limits<double>::infinity();
  for (int round = 0; round < kRounds; ++round) {
    const auto is_air = [&](int column, int row) {
      const float grey = image.at(column, row);
      return round == 0 ? grey <= most : std::abs(grey - last.at(column, row)) <= within;
    };
    if (!open.fit(image, round >= kPlanes, is_air)) return;
    std::vector<float> off;
    for (int row = 0; row < image.rows; row += kStride)
      for (int column = 0; column < image.columns; column += kStride)
        if (is_air(column, row))
          off.push_back(static_cast<float>(image.at(column, row) - open.at(column, row)));
    const double middle = level(off, 0.5);
    for (float& v : off) v = static_cast<float>(std::abs(v - middle));
    within = kWithin * kSdOfMad * level(off, 0.5);
    last = open;
  }
  for (int row = 0; row < image.rows; ++row)
    for (int column = 0; column < image.columns; ++column)
      image.at(column, row) -= static_cast<float>(open.at(column, row));
}

}  // namespace

void absorption_from_counts(MammogramImage& image, const CountsEncoding& encoding) {
  const auto taken = [&](bool brighter_is_more) {
    MammogramImage absorbed = absorption(image, encoding, brighter_is_more);
    absorbed.field = exposed_field(absorbed, encoding);
    return absorbed;
  };
  if (encoding.brighter_is_more) {
    image = taken(*encoding.brighter_is_more);
  } else {
    MammogramImage more = taken(true), less = taken(false);
    image = likeness(more, *more.field) >= likeness(less, *less.field) ? more : less;
  }
  repeat_border(image, *image.field);
  take_out_heel(image);
}

}  // namespace mammotwin
