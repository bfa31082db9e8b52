#include "pipeline/steps/compression_quality.h"

#include <cmath>

#include "pipeline/frame/sentence.h"
#include "pipeline/steps/quality_limits.h"

namespace mammotwin {
namespace {

using nlohmann::json;

json history_json(const CompressionReport& report) {
  json history = json::array();
  for (const CompressionStep& step : report.history)
    history.push_back({{"thickness_mm", step.thickness_mm},
                       {"force_N", step.force_N},
                       {"iterations", step.iterations},
                       {"penalty_kPa_per_mm", step.penalty},
                       {"min_J", step.min_J},
                       {"max_J", step.max_J}});
  return history;
}

json quality_of(const CompressionReport& r, double angle_deg) {
  return {{"angle_deg", angle_deg},
          {"target_thickness_mm", r.target_thickness_mm},
          {"thickness_mm", r.thickness_mm},
          {"free_thickness_mm", r.free_thickness_mm},
          {"compressed_fraction", 1 - r.thickness_mm / r.free_thickness_mm},
          {"force_N", r.force_N},
          {"energy_force_N", r.energy_force_N},
          {"paddle_tilt_deg", r.paddle_tilt_deg},
          {"contact_area_cm2", r.contact_area_cm2},
          {"gap_p95_mm", r.gap_p95_mm},
          {"volume_change", r.volume_change},
          {"min_J", r.min_J},
          {"max_J", r.max_J},
          {"J_within_half", r.J_within_half},
          {"mean_gap_mm", r.mean_gap_mm},
          {"max_penetration_mm", r.max_penetration_mm},
          {"imbalance_percent", 100 * r.imbalance},
          {"retained_fraction", r.retained_fraction},
          {"wall_gap_mm", r.wall_gap_mm},
          {"steps", r.steps},
          {"cutbacks", r.cutbacks},
          {"presses", r.presses},
          {"other_press_iterations", r.other_press_iterations},
          {"drawn_times", r.drawn_times},
          {"newton_iterations", r.newton_iterations},
          {"indefinite_matrices", r.indefinite_matrices},
          {"dof", r.dof},
          {"history", history_json(r)}};
}

}  // namespace

Outcome judge_compression(const CompressionReport& r, const PlateEscape& escape, double angle_deg,
                          bool assumed_thickness) {
  Outcome outcome;
  outcome.quality = quality_of(r, angle_deg);
  outcome.quality["thickness_assumed"] = assumed_thickness;
  outcome.quality["stopped_by_force"] = r.stopped_by_force;
  if (!r.usable()) {
    outcome.status = Status::not_converged;
    outcome.reasons = {r.reason};
    return outcome;
  }
  outcome.quality["swing_mm"] = escape.swing_mm;
  outcome.quality["roll_deg"] = escape.roll_deg;
  outcome.quality["slid_mm"] = escape.slid_mm;
  const auto doubt = [&](bool doubtful, const std::string& reason) {
    if (!doubtful) return;
    outcome.status = Status::look;
    outcome.reasons.push_back(reason);
  };
  doubt(std::abs(r.thickness_mm - r.target_thickness_mm) > limits::thickness_error_mm,
        sentence("the breast ended %.2f mm thick where %.2f mm were asked", r.thickness_mm,
                 r.target_thickness_mm));
  doubt(std::abs(r.volume_change) > limits::volume_change,
        sentence("its volume changed by %.2f %%; expected under %.0f %%", 100 * r.volume_change,
                 100 * limits::volume_change));
  doubt(r.mean_gap_mm > limits::mean_gap_mm,
        sentence("the plates press %.2f mm beside the skin in the mean; expected under %.2f mm",
                 r.mean_gap_mm, limits::mean_gap_mm));
  doubt(r.max_penetration_mm > limits::penetration_mm,
        sentence("a plate went %.3f mm into the breast; expected under %.1f mm",
                 r.max_penetration_mm, limits::penetration_mm));
  doubt(100 * r.imbalance > limits::imbalance_percent,
        sentence("forces between the plates are out of balance by %.2f %%; expected under %.1f %%",
                 100 * r.imbalance, limits::imbalance_percent));
  doubt(
      r.force_N > limits::force_N,
      sentence("the paddle presses with %.0f N; mammograms take less than %.0f N, so the breast is "
               "softer than its tissue here, or was not pressed so thin",
               r.force_N, limits::force_N));
  doubt(std::abs(escape.swing_mm) > limits::swing_mm,
        sentence("the nipple swung %.0f mm to the side between the plates; mammograms show less "
                 "than %.0f mm",
                 std::abs(escape.swing_mm), limits::swing_mm));
  doubt(escape.roll_deg > limits::roll_deg,
        sentence("the breast rolled over by %.0f degrees between the plates; expected under %.0f",
                 escape.roll_deg, limits::roll_deg));
  doubt(r.retained_fraction < limits::retained_fraction,
        sentence("the breast slid backwards: %.0f %% of the tissue in front of the plates' edges "
                 "stays there; expected at least %.0f %%",
                 100 * r.retained_fraction, 100 * limits::retained_fraction));
  doubt(r.drawn_times > 1,
        sentence("the breast came to rest between the plates only where it was drawn forward %.0f "
                 "times as hard as others are",
                 r.drawn_times));
  doubt(r.J_within_half < limits::share_of_sane_J,
        sentence("volume is locally kept within half at %.1f %% of the points; expected %.0f %%",
                 100 * r.J_within_half, 100 * limits::share_of_sane_J));
  return outcome;
}

}  // namespace mammotwin
