#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace mammotwin {

/// A drawn breast that two upright plates of a coil pressed while its MRI was taken.
struct CoilCase {
  int number = 0;                   ///< of the population (population.h)
  std::filesystem::path folder;     ///< gets its files
  double pressed = 0.4;             ///< share of its front half's width; 0: it hangs free
  std::vector<double> roundnesses;  ///< asked of the unloaded breast; 0: gravity only
};

/// The truth, of default tissue on the finer mesh of hanging_truth.h, hangs, is pressed and imaged
/// so; its MRI goes through segment, fit, unload and both compressions, each to the thickness that
/// the truth was pressed to. A row for each roundness: what was asked and what came of it
/// (`asked_roundness`, `roundness`), the same of the true breast free of load and as imaged
/// (`true_roundness`, `imaged_roundness`), the plates' own force and the one that was found
/// (`plates_N`, `found_N`), `shape_rms_mm` of the unloaded skin from the true one, how many times
/// as stiff `unload` took the tissue (`stiffened`), and in each view how far from its true place,
/// both relative to the nipple, the worst lesion comes to lie (`lesion_cc_mm`, `lesion_mlo_mm`).
/// What was not reached is null, with a `reason`.
void add_coil_rows(const CoilCase& asked, const std::function<void(const nlohmann::json&)>& add);

}  // namespace mammotwin
