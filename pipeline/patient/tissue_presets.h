#pragma once

#include <vector>

#include "pipeline/frame/settings.h"

namespace mammotwin {

/// Sets of what tissue is and what holds it, for `materials.preset`:
/// - `gel`: the paper's silicone, c1 = 3 kPa everywhere, no skin;
/// - `neo_hookean_2026`: moduli as published from measurements, which are too stiff under gravity;
/// - `real`: soft under gravity and stiff between plates, on a wall that lets the breast slide.
///   How it was chosen and what it does: docs/measured/tissue_real.md.
std::vector<Preset> tissue_presets();

/// What is taken of a patient whose patient.toml names none.
inline constexpr const char* kDefaultTissue = "real";

}  // namespace mammotwin
