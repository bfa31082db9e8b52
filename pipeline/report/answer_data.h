#pragma once

#include <nlohmann/json_fwd.hpp>

#include "pipeline/report/patient_results.h"

namespace mammotwin {

/// How far such predictions have been checked: stands beside every search ellipse.
inline constexpr const char* kAccuracyWords =
    "Accuracy has been measured on synthetic patients, and on few marks of real ones, which were "
    "centimetres off and within their ellipses; published methods lie 5 to 13 mm from "
    "the truth on real ones.";

/// What a supine place is worth, by docs/measured/gravity.md and women imaged in both poses
/// (there).
inline constexpr const char* kSupineWords =
    "Not calibrated to her: from prone to supine women's nipples move by 93 mm in the median (56 "
    "to 172), the default tissue's by 101 and neo_hookean_2026's by 15, so a place beside the ribs "
    "may be off by several centimetres. Seen from the nipple, 90 % is as wide as what landmarks of "
    "32 women did.";

/// The page's first words, in a report's language: a list of lesions, each {"lesion", "place",
/// "views": [{"view", "where", "search", "full", "not_registered", "in_doubt", "thickness"}],
/// "supine", "supine_doubt"}. `full` is the ellipse on a mammogram that was not there to be
/// searched, else empty; `not_registered` why the search left one that was, `in_doubt` why to look
/// at one that it took; `thickness` says what was assumed of the view's, or is empty. Empty without
/// rows of lesions.csv.
nlohmann::json answer_data(const PatientResults& results);

}  // namespace mammotwin
