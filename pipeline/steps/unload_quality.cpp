#include "pipeline/steps/unload_quality.h"

#include <cmath>

#include "pipeline/frame/sentence.h"
#include "pipeline/steps/quality_limits.h"

namespace mammotwin {
namespace {

using nlohmann::json;

json optional_number(const std::optional<double>& value) { return value ? json(*value) : json(); }

json fit_json(const StiffnessFit& fit) {
  json at_one = std::isfinite(fit.distance_at_one_mm) ? json(fit.distance_at_one_mm) : json();
  return {{"factor", fit.factor},
          {"distance_mm", fit.distance_mm},
          {"distance_at_one_mm", at_one},
          {"trials", fit.trials}};
}

json coil_json(const UnloadingRecord& record) {
  if (!record.coil) return {};
  json coil = {{"roundness_imaged", record.coil->roundness}, {"plates", nullptr}};
  if (const auto& plates = record.coil->plates)
    coil["plates"] = {{"apart_mm", plates->apart_mm},
                      {"left_cm2", plates->left_cm2},
                      {"right_cm2", plates->right_cm2}};
  const bool released = record.release.has_value();
  coil["roundness"] = released ? json(record.release->fit.figure) : json();
  coil["way_mm"] = released ? json(record.release->fit.way_mm) : json();
  coil["force_N"] = released ? json(record.report.skin_force_N) : json();
  return coil;
}

std::string coil_sentence(const UnloadingRecord& record) {
  std::string text = sentence(
      "the coil seems to have pressed the breast flat from both sides: its front half is %.2f "
      "times as wide as high",
      record.coil->roundness);
  if (const auto& plates = record.coil->plates)
    text += sentence(", and %.0f and %.0f cm2 of its skin are plane and parallel, %.0f mm apart",
                     plates->left_cm2, plates->right_cm2, plates->apart_mm);
  if (!record.release) return text + "; only gravity is taken off, so it stays as narrow";
  text += sentence(
      "; let go it is taken to be %.2f times as wide as high (unload.coil_roundness), for which "
      "plates would have pressed with %.0f N: nobody saw it so",
      record.release->fit.figure, record.report.skin_force_N);
  if (!record.release->fit.reason.empty()) text += " (rounder: " + record.release->fit.reason + ")";
  return text;
}

json quality_of(const UnloadingRecord& record) {
  const UnloadReport& r = record.report;
  json quality = {{"gravity", name_of(record.imaged)},
                  {"gravity_factor", r.gravity_fraction},
                  {"stability_margin", r.stability_margin},
                  {"stiffness_factor", record.stiffness_factor},
                  {"stiffened", record.stiffened},
                  {"sag_max_mm", r.sag_max_mm},
                  {"round_trip_max_mm", r.round_trip_max_mm},
                  {"round_trip_rms_mm", r.round_trip_rms_mm},
                  {"naive_reversal_error_mm", optional_number(r.naive_reversal_error_mm)},
                  {"stretch_p95", r.stretch_p95},
                  {"stretch_max", r.stretch_max},
                  {"min_J", r.min_J},
                  {"max_J", r.max_J},
                  {"coil", coil_json(record)},
                  {"steps", r.steps},
                  {"newton_iterations", r.newton_iterations},
                  {"dof", r.dof}};
  for (const auto& [name, pose] : record.poses)
    if (pose.result.report.usable()) {
      quality[name + "_sag_max_mm"] = pose.result.report.sag_max_mm;
      quality[name + "_slide_max_mm"] = pose.wall_slide_mm;
      quality[name + "_move_max_mm"] = pose.move_mm;
    }
  if (record.stiffness_fit && record.stiffness_fit->usable())
    quality["stiffness_fit"] = fit_json(*record.stiffness_fit);
  return quality;
}

std::string too_soft(const UnloadingRecord& record) {
  const UnloadReport& r = record.report;
  if (r.gravity_fraction <= 0)
    return "no unloaded shape was found, not even for a part of the gravity: " + r.reason;
  // A stiffness a little above the smallest: two digits, rounded up.
  const double factor =
      std::ceil(100 * record.stiffness_factor * r.sufficient_stiffness_factor()) / 100;
  return sentence(
             "no unloaded shape holds with these stiffnesses beyond %.0f %% of the gravity; "
             "materials.stiffness_factor = %.2f is enough (",
             100 * r.gravity_fraction, factor) +
         r.reason + ")";
}

}  // namespace

void stiffen_as_needed(UnloadingRecord& record) {
  constexpr double most = 8;
  UnloadReport& report = record.report;
  if (report.usable() || !(report.sufficient_stiffness_factor() <= most)) return;
  record.stiffened = report.sufficient_stiffness_factor();
  record.stiffness_factor *= record.stiffened;
  report.converged = true;
  report.gravity_fraction = 1;
}

Outcome judge_unloading(const UnloadingRecord& record) {
  Outcome outcome;
  outcome.quality = quality_of(record);
  if (record.stiffness_fit && !record.stiffness_fit->usable())
    return {Status::not_converged, {record.stiffness_fit->reason}, outcome.quality};
  if (!record.report.usable()) {
    outcome.status = Status::not_converged;
    outcome.quality["sufficient_stiffness_factor"] =
        record.report.gravity_fraction > 0
            ? json(record.stiffness_factor * record.report.sufficient_stiffness_factor())
            : json();
    outcome.reasons = {too_soft(record)};
    return outcome;
  }
  const auto doubt = [&](bool doubtful, const std::string& reason) {
    if (!doubtful) return;
    outcome.status = Status::look;
    outcome.reasons.push_back(reason);
  };
  doubt(record.report.stretch_p95 > limits::stretch_p95,
        sentence("hanging stretches 5 %% of the breast by more than %.2f; are the stiffnesses too "
                 "low?",
                 record.report.stretch_p95));
  doubt(record.stiffened > limits::stiffened,
        sentence("the tissue was taken %.2f times as stiff as set: no softer breast hangs as this "
                 "one does (is the chest wall right, and is skin where the mesh has it?)",
                 record.stiffened));
  doubt(
      record.report.round_trip_max_mm > limits::round_trip_mm,
      sentence("loaded again, tissue comes to rest up to %.0f mm from where it was imaged (%.1f mm "
               "in the root mean square): it is not stable there (is the chest wall right?)",
               record.report.round_trip_max_mm, record.report.round_trip_rms_mm));
  if (record.coil) doubt(true, coil_sentence(record));
  for (const auto& [name, pose] : record.poses) {
    const HangReport& r = pose.result.report;
    doubt(!r.usable(), "the breast does not come to rest " + name + ": " + r.reason +
                           "; no markups are written for that state");
    doubt(
        r.usable() && pose.move_mm > limits::pose_move_mm,
        sentence("%s, the breast goes as far as %.0f mm from where it was imaged; women's nipples "
                 "go 56 to 172 mm from prone to supine: do not believe its places there",
                 name.c_str(), pose.move_mm));
  }
  return outcome;
}

}  // namespace mammotwin
