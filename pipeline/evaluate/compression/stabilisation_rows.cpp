#include "pipeline/evaluate/compression/stabilisation_rows.h"

#include <nlohmann/json.hpp>
#include <optional>

#include "pipeline/evaluate/cases/stage_command.h"
#include "pipeline/evaluate/compression/breast_stages.h"
#include "pipeline/patient/patient.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

struct Stabilisation {
  double weight, quartic;
  bool operator==(const Stabilisation&) const = default;
  std::string name() const { return json(weight).dump() + "_" + json(quartic).dump(); }
};

/// What the breast's own settings say, tissue's among them.
Stabilisation own_stabilisation(const BreastToPress& breast) {
  Patient patient;
  patient.read(breast.patient_toml);
  const SolidOptions& solid = patient.compression.options.solid;
  return {solid.grad_div, solid.quartic};
}

/// Its own first: the others are compared with that. Without weight there is no quartic part.
std::vector<Stabilisation> stabilisations(const Stabilisation& own) {
  std::vector<Stabilisation> all{own};
  for (const Stabilisation& s :
       {Stabilisation{0, 0}, {5, 0}, {5, own.quartic}, {10, 0}, {10, own.quartic}})
    if (s != own) all.push_back(s);
  return all;
}

/// One breast under way: segmented and fitted, pressed by the default, then otherwise.
class StabilisationRun {
 public:
  explicit StabilisationRun(const BreastToPress& breast)
      : stages_(breast), own_(own_stabilisation(breast)), prone_(breast.folder / "prone.vtu") {
    stages_.fit(prone_);
    followed_.emplace(stages_.segmentation(), prone_);
  }

  std::vector<Stabilisation> all() const { return stabilisations(own_); }

  json row(const std::string& view, const Stabilisation& s) const {
    json row{{"name", stages_.breast().name}, {"view", view},       {"weight", s.weight},
             {"quartic", s.quartic},          {"converged", false}, {"reason", nullptr},
             {"is_default", s == own_}};
    for (const char* key :
         {"force_N", "force_change", "lesion_median_mm", "lesion_max_mm", "tissue_median_mm",
          "tissue_max_mm", "min_J", "max_J", "J_within_half", "newton_iterations", "cpu_seconds"})
      row[key] = nullptr;
    try {
      row["cpu_seconds"] = press(view, s);
    } catch (const std::exception& error) {
      row["reason"] = error.what();
      return row;
    }
    row["converged"] = true;
    const json quality = stage_sidecar(pressed(view, s)).at("quality");
    for (const char* key : {"force_N", "min_J", "max_J", "J_within_half", "newton_iterations"})
      row[key] = quality.at(key);
    compare_with_own(view, s, row);
    return row;
  }

 private:
  fs::path pressed(const std::string& view, const Stabilisation& s) const {
    return stages_.breast().folder / s.name() / (view + ".vtu");
  }

  double press(const std::string& view, const Stabilisation& s) const {
    return stages_.press(
        view, prone_, pressed(view, s),
        {"--grad-div", json(s.weight).dump(), "--grad-div-quartic", json(s.quartic).dump()});
  }

  void compare_with_own(const std::string& view, const Stabilisation& s, json& row) const {
    const fs::path base = pressed(view, own_);
    if (fs::exists(base)) stages_.compare(*followed_, view, base, pressed(view, s), row);
  }

  const BreastStages stages_;
  const Stabilisation own_;
  const fs::path prone_;
  std::optional<FollowedPoints> followed_;
};

}  // namespace

void add_stabilisation_rows(const BreastToPress& breast,
                            const std::function<void(const nlohmann::json&)>& add) {
  const StabilisationRun run(breast);
  for (const char* view : {"cc", "mlo"})
    for (const Stabilisation& s : run.all()) add(run.row(view, s));
}

}  // namespace mammotwin
