#include "pipeline/patient/tissue_presets.h"

#include <string>

namespace mammotwin {
namespace {

/// What differs between the sets, as it is written in patient.toml; by default neo_hookean_2026.
struct Tissue {
  std::string law = "neo_hookean";
  std::string fat_c1 = "0.75", fibroglandular_c1 = "2.5", lesion_c1 = "3.3";
  std::string stiffening = "1", most_stiffening = "1e6";
  std::string factor = "1", membrane = "true", spring = "0.08", smoothing = "5";
  std::string pull = "0", quartic = "20";
};

Preset preset_of(const std::string& name, const Tissue& tissue) {
  Preset preset{name, {}};
  const auto add = [&](const std::string& key, const std::string& value) {
    preset.values.emplace_back(key, value);
  };
  for (const auto& [kind, c1] :
       {std::pair("fat", tissue.fat_c1), std::pair("fibroglandular", tissue.fibroglandular_c1),
        std::pair("lesion", tissue.lesion_c1)}) {
    const std::string prefix = std::string("materials.") + kind + ".";
    add(prefix + "law", tissue.law);
    add(prefix + "c1_kpa", c1);
    add(prefix + "stiffening", tissue.stiffening);
    add(prefix + "most_stiffening", tissue.most_stiffening);
  }
  add("materials.stiffness_factor", tissue.factor);
  add("materials.skin.membrane", tissue.membrane);
  add("compress.chest_wall_spring_kpa_per_mm", tissue.spring);
  add("compress.chest_wall_smoothing_mm", tissue.smoothing);
  add("compress.pull", tissue.pull);
  add("compress.grad_div_quartic", tissue.quartic);
  return preset;
}

}  // namespace

std::vector<Preset> tissue_presets() {
  Tissue gel, real;
  gel.fat_c1 = gel.fibroglandular_c1 = gel.lesion_c1 = "3";
  gel.membrane = "false";
  real.law = "exponential";
  real.stiffening = "4.5";
  real.most_stiffening = "18";
  real.factor = "0.12";
  real.spring = "0.04";
  real.smoothing = "20";
  real.pull = "1";
  // Tissue that stiffens many times over outgrows the term that keeps each point's volume.
  real.quartic = "400";
  return {preset_of("gel", gel), preset_of("neo_hookean_2026", {}), preset_of("real", real)};
}

}  // namespace mammotwin
