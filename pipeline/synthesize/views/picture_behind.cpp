#include "pipeline/synthesize/views/picture_behind.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "pipeline/synthesize/implicit.h"

namespace mammotwin {
namespace {

constexpr double kRear_mm = 10;       // thinner says nothing of its tissue
constexpr double kStillBreast = 0.8;  // of the plates' distance, in a row that shows the breast
constexpr double kMuscleShare = 0.7;  // of the thickness that muscle fills behind its edge
constexpr double kMuscleRim_mm = 8;   // over which it grows to that
constexpr double kMuscleAtTop = 0.6;  // most of the tissue's depth there that lies behind its edge

/// One row of the picture, from the detector's edge.
class Row {
 public:
  Row(const SimulatedView& simulated, int j)
      : thickness_(row_of(simulated.thickness, j)), values_(row_of(simulated.attenuation, j)) {}

  double thickest_mm() const { return *std::ranges::max_element(thickness_); }

  /// As thick as the breast is in front of it, and no thicker than the plates are apart.
  void fill_rear(double plates_mm) {
    double per_mm = 0, thickest_mm = 0;  // of the last tissue in front; so far
    for (long i = static_cast<long>(values_.size()) - 1; i >= 0; --i) {
      if (thickness_[i] >= kRear_mm) per_mm = values_[i] / thickness_[i];
      thickest_mm = std::min(plates_mm, std::max(thickest_mm, thickness_[i]));
      if (thickest_mm < kRear_mm) continue;
      thickness_[i] = thickest_mm;
      values_[i] = per_mm * thickest_mm;
    }
  }

  /// Steps from the detector's edge to where the breast is as thin as its rim.
  long to_skin() const {
    const auto skin = std::find_if(thickness_.rbegin(), thickness_.rend(),
                                   [](double t) { return t >= kRear_mm; });
    return thickness_.rend() - skin;
  }

  double thickness_mm(int i) const { return thickness_[i]; }
  double value(int i) const { return values_[i]; }

 private:
  static std::vector<double> row_of(const DetectorImage& image, int j) {
    const auto first = image.values.begin() + static_cast<long>(j) * image.columns;
    return {first, first + image.columns};
  }

  std::vector<double> thickness_, values_;
};

/// The edge turned about where it meets the detector's, so that it leaves tissue in front of it at
/// the image's top, as women's does: the wall's line is straight only near the nipple.
MuscleEdge with_tissue_before_it(const MuscleEdge& edge, double top_v_mm, double most_u_mm) {
  const Eigen::Vector2d along(-edge.towards_skin.y(), edge.towards_skin.x());
  const double at_top_mm = edge.at.x() + along.x() / along.y() * (top_v_mm - edge.at.y());
  if (at_top_mm <= most_u_mm) return edge;
  const Eigen::Vector2d meets(0, edge.at.y() - along.y() / along.x() * edge.at.x());
  const Eigen::Vector2d way = (Eigen::Vector2d(most_u_mm, top_v_mm) - meets).normalized();
  Eigen::Vector2d squarely(way.y(), -way.x());
  if (squarely.x() < 0) squarely = -squarely;
  return {meets, squarely};
}

/// `value` of a ray through so much tissue, with muscle in it as far as it lies behind the edge.
double with_muscle(double value, double thickness_mm, double behind_mm, const Attenuation& mu) {
  const double share = kMuscleShare * smooth_step(0, kMuscleRim_mm, behind_mm);
  return (1 - share) * value + share * thickness_mm * mu.lesion;  // soft tissue without fat, too
}

}  // namespace

DetectorImage picture_behind(const SimulatedView& simulated, double plates_mm,
                             const std::optional<MuscleEdge>& muscle, double top_v_mm,
                             const Attenuation& attenuation) {
  const DetectorImage& seen = simulated.attenuation;
  const bool top_is_low = top_v_mm < seen.first.y() + seen.spacing_mm * seen.rows / 2;
  std::vector<Row> rows;  // from the top
  for (int j = 0; j < seen.rows; ++j)
    rows.emplace_back(simulated, top_is_low ? j : seen.rows - 1 - j);
  const auto topmost = std::ranges::find_if(
      rows, [&](const Row& row) { return row.thickest_mm() >= kStillBreast * plates_mm; });
  for (Row& row : rows) row.fill_rear(plates_mm);

  DetectorImage picture = seen;
  std::optional<MuscleEdge> edge;
  long goes_on = 0;
  int above = 0;
  if (muscle && topmost != rows.end()) {
    goes_on = topmost - rows.begin();
    edge = with_tissue_before_it(*muscle, top_v_mm,
                                 kMuscleAtTop * seen.spacing_mm * topmost->to_skin());
    const double first_v_mm = seen.first.y() + (top_is_low ? 0 : seen.rows - 1) * seen.spacing_mm;
    above = std::max(
        0, static_cast<int>(std::ceil((top_is_low ? first_v_mm - top_v_mm : top_v_mm - first_v_mm) /
                                      seen.spacing_mm)));
    picture.rows += above;
    if (top_is_low) picture.first.y() -= above * seen.spacing_mm;
    picture.values.resize(static_cast<std::size_t>(picture.columns) * picture.rows);
  }
  for (int j = 0; j < picture.rows; ++j) {  // from the top
    const Row& row = rows[std::max<long>(j - above, goes_on)];
    const int stored = top_is_low ? j : picture.rows - 1 - j;
    for (int i = 0; i < picture.columns; ++i) {
      double& value = picture.values[static_cast<std::size_t>(stored) * picture.columns + i];
      value = row.value(i);
      if (!edge) continue;
      const Eigen::Vector2d uv = picture.first + picture.spacing_mm * Eigen::Vector2d(i, stored);
      value = with_muscle(value, row.thickness_mm(i), -edge->towards_skin.dot(uv - edge->at),
                          attenuation);
    }
  }
  return picture;
}

}  // namespace mammotwin
