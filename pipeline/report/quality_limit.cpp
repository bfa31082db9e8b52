#include "pipeline/report/quality_limit.h"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "fitting/fit_limits.h"
#include "pipeline/report/word.h"
#include "pipeline/steps/quality_limits.h"
#include "segmentation/segment_limits.h"

namespace mammotwin {
namespace {

constexpr double kNone = INFINITY;

struct Limit {
  const char *product, *key;
  double low, high;
  const char* unit;
};

constexpr Limit kLimits[] = {
    {"segmentation.seg.nrrd", "breast_volume_ml", limits::least_breast_ml, limits::most_breast_ml,
     " ml"},
    {"segmentation.seg.nrrd", "chest_wall_doubt", -kNone, limits::chest_wall_doubt, ""},
    {"segmentation.seg.nrrd", "chest_wall_fat_behind", -kNone, limits::chest_wall_fat_behind, ""},
    {"segmentation.seg.nrrd", "chest_wall_unsteady", -kNone, limits::chest_wall_unsteady, ""},
    {"segmentation.seg.nrrd", "pre_shift_mm", -kNone, limits::pre_shift_mm, " mm"},
    {"segmentation.seg.nrrd", "signal_to_noise", limits::signal_to_noise, kNone, ""},
    {"segmentation.seg.nrrd", "volume_ratio", limits::volume_ratio, kNone, ""},
    {"prone.vtu", "skin_rms_mesh_to_data_mm", -kNone, limits::skin_rms_mm, " mm"},
    {"prone.vtu", "skin_rms_data_to_mesh_mm", -kNone, limits::skin_rms_mm, " mm"},
    {"prone.vtu", "skin_p95_mm", -kNone, limits::skin_p95_mm, " mm"},
    {"prone.vtu", "chest_wall_rms_mm", -kNone, limits::chest_wall_rms_mm, " mm"},
    {"prone.vtu", "covered_fraction", limits::covered_breast, kNone, ""},
    {"prone.vtu", "covered_lesions", limits::covered_lesions, kNone, ""},
    {"prone.vtu", "min_jacobian_bound", 0, kNone, ""},
    {"unloaded.vtu", "stretch_p95", -kNone, limits::stretch_p95, ""},
};

constexpr Limit kOfViews[] = {
    {"", "volume_change", -limits::volume_change, limits::volume_change, ""},
    {"", "mean_gap_mm", -kNone, limits::mean_gap_mm, " mm"},
    {"", "max_penetration_mm", -kNone, limits::penetration_mm, " mm"},
    {"", "imbalance_percent", -kNone, limits::imbalance_percent, " %"},
    {"", "J_within_half", limits::share_of_sane_J, kNone, ""},
    {"", "force_N", -kNone, limits::force_N, " N"},
    {"", "swing_mm", -limits::swing_mm, limits::swing_mm, " mm"},
    {"", "roll_deg", -kNone, limits::roll_deg, "°"},
    {"", "retained_fraction", limits::retained_fraction, kNone, ""},
};

std::string shown(double value, const char* unit) {
  const int decimals = std::abs(value) >= 10 || value == std::round(value) ? 0 : 2;
  return word::number(value, decimals) + unit;
}

std::string words_of(const Limit& limit) {
  if (std::isinf(limit.low)) return "at most " + shown(limit.high, limit.unit);
  if (std::isinf(limit.high))
    return (limit.low == 0 ? "above " : "at least ") + shown(limit.low, limit.unit);
  if (limit.low == -limit.high) return "within ± " + shown(limit.high, limit.unit);
  return shown(limit.low, "") + " to " + shown(limit.high, limit.unit);
}

bool holds(const Limit& limit, double value) {
  if (limit.low == 0 && std::isinf(limit.high)) return value > 0;
  return value >= limit.low && value <= limit.high;
}

/// A view's thickness is judged against the one that was asked for.
std::optional<QualityExpectation> thickness(const nlohmann::json& quality) {
  if (!quality.contains("target_thickness_mm") || !quality["target_thickness_mm"].is_number())
    return {};
  const double target = quality["target_thickness_mm"];
  return QualityExpectation{
      word::number(target, 2) + " ± " + shown(limits::thickness_error_mm, " mm"),
      std::abs(quality["thickness_mm"].get<double>() - target) <= limits::thickness_error_mm};
}

}  // namespace

std::optional<QualityExpectation> expectation(const std::string& product, const std::string& key,
                                              const nlohmann::json& quality) {
  if (!quality.contains(key) || !quality[key].is_number()) return {};
  const bool view = product == "cc.vtu" || product == "mlo.vtu";
  if (view && key == "thickness_mm") return thickness(quality);
  const auto find = [&](auto begin, auto end,
                        const std::string& of) -> std::optional<QualityExpectation> {
    const auto at =
        std::find_if(begin, end, [&](const Limit& l) { return of == l.product && key == l.key; });
    if (at == end) return {};
    return QualityExpectation{words_of(*at), holds(*at, quality[key].get<double>())};
  };
  return view ? find(std::begin(kOfViews), std::end(kOfViews), "")
              : find(std::begin(kLimits), std::end(kLimits), product);
}

}  // namespace mammotwin
