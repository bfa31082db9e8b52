#include "pipeline/patient/tissue_presets.h"

#include <string>

namespace mammotwin {
namespace {

/// What differs between the sets; numbers as they are written in patient.toml.
struct Tissue {
  std::string law, fat_c1, fibroglandular_c1, lesion_c1, stiffening, factor, membrane, spring,
      smoothing;
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
  }
  add("materials.stiffness_factor", tissue.factor);
  add("materials.skin.membrane", tissue.membrane);
  add("compress.chest_wall_spring_kpa_per_mm", tissue.spring);
  add("compress.chest_wall_smoothing_mm", tissue.smoothing);
  return preset;
}

}  // namespace

std::vector<Preset> tissue_presets() {
  return {
      preset_of("gel", {"neo_hookean", "3", "3", "3", "1", "1", "false", "0.08", "5"}),
      preset_of("neo_hookean_2026",
                {"neo_hookean", "0.75", "2.5", "3.3", "1", "1", "true", "0.08", "5"}),
      preset_of("real", {"exponential", "0.75", "2.5", "3.3", "1.3", "0.14", "true", "0.04", "20"}),
  };
}

}  // namespace mammotwin
