#pragma once

#include <nlohmann/json_fwd.hpp>

namespace mammotwin {

/// How honest the search ellipses of all patients' rows (`registration_row`) are together, and what
/// the marks are worth: rows "all marks", "lesions", "points of gland", "in the image", "beside the
/// image", the smallest, middle and largest third of the ellipses, "CC", "MLO", "3-D".
///   marks, inside_50, inside_90     how many, and shares of them inside their ellipse
///   major_90_mm                     median of the semi-major axes of the 90 % ellipses
///   median_error_mm, p95_error_mm   how far marks are off
/// Rows of views and 3-D hold errors alone, and
///   nearer_than_baseline            "n of m": patients whose median is under the baseline's
///   over_20_mm_said                 "n of m": of the patients with a median over 20 mm those whose
///                                   search ended as no registration
nlohmann::json ellipse_rows(const nlohmann::json& rows);

}  // namespace mammotwin
