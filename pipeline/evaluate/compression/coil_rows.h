#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <vector>

namespace mammotwin {

/// A drawn breast that two upright plates of a coil pressed while its MRI was taken.
struct CoilCase {
  int number = 0;                 ///< of the population (population.h)
  std::filesystem::path folder;   ///< gets its files
  double pressed = 0.4;           ///< share of its front half's width; 0: it hangs free
  std::vector<double> pressures;  ///< to take off [kPa]; 0: gravity only
};

/// The truth, of default tissue on the finer mesh of hanging_truth.h, hangs, is pressed and imaged
/// so; its MRI goes through segment, fit, unload and both compressions, each to the thickness that
/// the truth was pressed to. A row for each pressure: that pressure (`taken_off_kpa`), the plates'
/// own force and mean pressure (`plates_N`, `plates_kpa`), the plane skin that was found
/// (`left_cm2`, `right_cm2`, `apart_mm`), `shape_rms_mm` of the unloaded skin from the true one,
/// how many times as stiff `unload` took the tissue (`stiffened`), and in each view how far from
/// its true place, both relative to the nipple, the worst lesion comes to lie (`lesion_cc_mm`,
/// `lesion_mlo_mm`). What was not reached is null, with a `reason`.
void add_coil_rows(const CoilCase& asked, const std::function<void(const nlohmann::json&)>& add);

}  // namespace mammotwin
