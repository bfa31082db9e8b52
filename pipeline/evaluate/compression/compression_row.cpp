#include "pipeline/evaluate/compression/compression_row.h"

#include <cmath>
#include <csignal>
#include <fstream>

#include "pipeline/evaluate/cases/stage_command.h"
#include "pipeline/frame/sentence.h"
#include "pipeline/steps/quality_limits.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

// What "reached" means.
constexpr double kLeastFraction = 0.05;  // less than this is no compression

json new_row(const EvaluatedBreast& breast, const PreparedBreast& prepared, const AskedView& view) {
  json row = prepared.facts;
  row["name"] = breast.name;
  row["view"] = view.view;
  row["angle_deg"] = view.angle_deg;
  row["target_thickness_mm"] = row["target_fraction"] = row["free_thickness_mm"] = nullptr;
  if (prepared.usable()) {
    row["target_thickness_mm"] = view.thickness_mm;
    row["free_thickness_mm"] = view.free_thickness_mm;
    row["target_fraction"] = 1 - view.thickness_mm / view.free_thickness_mm;
  }
  row["reached"] = false;
  row["possible"] = true;
  for (const char* key : {"compressed_fraction", "min_J", "newton_iterations", "seconds", "reason"})
    row[key] = nullptr;
  return row;
}

/// The sidecar that the stage left, or one in its form that says how its process ended.
json sidecar_after(const StageEnd& end, const fs::path& sidecar, int most_cpu_seconds) {
  if (end.exit_code < 128 && fs::exists(sidecar)) return json::parse(std::ifstream(sidecar));
  const int signal = end.exit_code - 128;
  const std::string reason = signal == SIGXCPU || signal == SIGKILL
                                 ? sentence("stopped after %d s of CPU", most_cpu_seconds)
                                 : sentence("ended with code %d", end.exit_code);
  return {{"status", "refused"}, {"reasons", {reason}}};
}

}  // namespace

void judge_row(json& row, const json& sidecar) {
  const json quality = sidecar.value("quality", json::object());
  for (const char* key : {"compressed_fraction",
                          "thickness_mm",
                          "min_J",
                          "max_J",
                          "J_within_half",
                          "mean_gap_mm",
                          "max_penetration_mm",
                          "swing_mm",
                          "roll_deg",
                          "force_N",
                          "retained_fraction",
                          "drawn_times",
                          "contact_area_cm2",
                          "volume_change",
                          "presses",
                          "steps",
                          "cutbacks",
                          "newton_iterations",
                          "indefinite_matrices",
                          "dof"})
    row[key] = quality.contains(key) ? quality[key] : json();
  const std::string status = sidecar.at("status");
  if (status != "ok" && status != "look") {
    row["reason"] = sidecar.at("reasons").at(0);
    return;
  }
  const double error =
      quality.at("thickness_mm").get<double>() - row.at("target_thickness_mm").get<double>();
  const double apart = quality.at("mean_gap_mm"), inside = quality.at("max_penetration_mm"),
               sane = quality.at("J_within_half");
  if (!(std::abs(error) <= limits::thickness_error_mm))
    row["reason"] = sentence("%.2f mm off the thickness asked", error);
  else if (!(apart <= limits::mean_gap_mm))
    row["reason"] = sentence("plates press %.3f mm beside the skin in the mean", apart);
  else if (!(inside < limits::penetration_mm))
    row["reason"] = sentence("a point stays %.3f mm inside a plate", inside);
  else if (!(sane >= limits::share_of_sane_J))
    row["reason"] = sentence("J is within 0.5 to 1.5 at %.2f %% of the points only", 100 * sane);
  else
    row["reached"] = true;
}

json compression_row(const EvaluatedBreast& breast, const PreparedBreast& prepared,
                     const AskedView& view, int most_cpu_seconds) {
  json row = new_row(breast, prepared, view);
  if (!prepared.usable()) {
    row["reason"] = prepared.reason;
    return row;
  }
  if (row.at("target_fraction") < kLeastFraction) {
    row["possible"] = false;
    row["reason"] = sentence("its free extent of %.1f mm is too thin to be pressed to %.1f mm",
                             view.free_thickness_mm, view.thickness_mm);
    return row;
  }
  const auto file = [&](const std::string& name) { return (breast.folder / name).string(); };
  const fs::path sidecar = file(view.view + ".vtu.json");
  const auto time_of = [&] {
    return fs::exists(sidecar) ? fs::last_write_time(sidecar) : fs::file_time_type::min();
  };
  const auto before = time_of();
  const StageEnd end = run_stage_command(
      "compress",
      {view.view, file("segmentation.seg.nrrd"), file("fractions.nrrd"), breast.mesh().string(),
       file(view.view + ".vtu"), "--patient", file("patient.toml")},
      file(view.view + ".log"), most_cpu_seconds);
  const json result = sidecar_after(end, sidecar, most_cpu_seconds);
  row["seconds"] = result.contains("seconds") ? result["seconds"] : json();
  // A product that was up to date was not made now.
  row["cpu_seconds"] = time_of() != before ? json(end.cpu_seconds) : json();
  judge_row(row, result);
  return row;
}

}  // namespace mammotwin
