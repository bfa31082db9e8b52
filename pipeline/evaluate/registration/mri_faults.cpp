#include "pipeline/evaluate/registration/mri_faults.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <optional>
#include <vector>

namespace mammotwin {
namespace {

using nlohmann::json;

/// Towards the flank, from the body's middle: the patient's left has larger x.
double lateral(Side side) { return side == Side::left ? 1 : -1; }

json markup(json markup) {
  markup["coordinateSystem"] = "LPS";
  return {{"markups", {std::move(markup)}}};
}

/// Foremost voxel of muscle in column i of slice k [mm, posterior]; none where there is no tissue
/// in front of it.
std::optional<double> muscle_front(const Volume<std::uint8_t>& labels, int i, int k) {
  for (int j = 1; j < labels.size.y(); ++j)
    if (labels(i, j, k) == label::muscle) {
      if (labels(i, j - 1, k) == label::air) return std::nullopt;
      return labels.position(i, j, k).y() - labels.spacing.y() / 2;
    }
  return std::nullopt;
}

}  // namespace

json region_without_flank(const Segmentation& truth, double share) {
  constexpr double kBesideLesion_mm = 10;
  const double out = lateral(truth.region.side);
  std::vector<double> places;
  const auto& labels = truth.labels;
  for (int k = 0; k < labels.size.z(); ++k)
    for (int j = 0; j < labels.size.y(); ++j)
      for (int i = 0; i < labels.size.x(); ++i)
        if (label::is_breast(labels(i, j, k)) && truth.region.contains(labels.position(i, j, k)))
          places.push_back(out * labels.position(i, j, k).x());
  const auto cut = places.begin() + std::lround((1 - share) * (places.size() - 1));
  std::nth_element(places.begin(), cut, places.end());
  double side = *cut;
  for (const Lesion& lesion : truth.lesions)
    side = std::max(side, out * lesion.centroid_in_lps.x() + kBesideLesion_mm);
  const double x_min = out > 0 ? truth.region.x_min : -side,
               x_max = out > 0 ? side : truth.region.x_max;
  constexpr double kDepth_mm = 1000;  // of no account
  return markup(
      {{"type", "ROI"},
       {"roiType", "Box"},
       {"center", {(x_min + x_max) / 2, 0, (truth.region.z_min + truth.region.z_max) / 2}},
       {"orientation", {1, 0, 0, 0, 1, 0, 0, 0, 1}},
       {"size", {x_max - x_min, kDepth_mm, truth.region.z_max - truth.region.z_min}}});
}

json wall_off_laterally(const Segmentation& truth, double off_mm) {
  constexpr double kSlices_mm = 30, kPoints_mm = 15;
  const double out = lateral(truth.region.side);
  const double flank = out > 0 ? truth.region.x_max : -truth.region.x_min;
  const double nipple = out * truth.nipple_in_lps.x();
  const auto& labels = truth.labels;
  json curves = json::array();
  const int slice_step = static_cast<int>(std::lround(kSlices_mm / labels.spacing.z()));
  const int point_step = static_cast<int>(std::lround(kPoints_mm / labels.spacing.x()));
  for (int k = 0; k < labels.size.z(); k += slice_step) {
    json points = json::array();
    for (int i = 0; i < labels.size.x(); i += point_step) {
      const Eigen::Vector3d x = labels.position(i, 0, k);
      const auto front = truth.region.contains(x) ? muscle_front(labels, i, k) : std::nullopt;
      if (!front) continue;
      const double share = std::clamp((out * x.x() - nipple) / (flank - nipple), 0., 1.);
      points.push_back({{"id", std::to_string(points.size() + 1)},
                        {"position", {x.x(), *front + share * off_mm, x.z()}}});
    }
    if (points.size() > 1)
      curves.push_back(
          {{"type", "Curve"}, {"coordinateSystem", "LPS"}, {"controlPoints", std::move(points)}});
  }
  return {{"markups", std::move(curves)}};
}

}  // namespace mammotwin
