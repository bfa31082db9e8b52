#pragma once

#include <nlohmann/json_fwd.hpp>

#include "pipeline/evaluate/cases/read_mammogram.h"
#include "pipeline/frame/products.h"
#include "registration/mammogram/mammogram_findings.h"

namespace mammotwin {

/// file, view, outline_worst_mm, nipple_mm, nipple_sd_mm, pectoral_worst_mm, pectoral_sd_mm,
/// unsure, view_doubted and remarks: how far the findings lie from what was read; null where either
/// is missing.
nlohmann::json mammogram_row(const ReadMammogram& read, const MammogramFindings& found);

/// How a breast lies in an oblique view, against the image's edge at the chest wall: as read, the
/// muscle's line (muscle_slope_deg) and the nipple's depth behind that edge over its distance from
/// that line (nipple_share); and the chord of the outline found from 25 mm above the nipple to 25
/// mm below (skin_slope_deg, null where it does not reach). Slopes are positive where what lies
/// above is deeper. Empty where nobody read muscle and nipple. `columns`: of the image.
nlohmann::json positioning_row(const ReadMammogram& read, std::vector<Eigen::Vector2d> outline,
                               int columns);

/// Whether the view is doubted when called by the other's name (other_view_noticed) and, of an
/// oblique one, upside down (upside_down_noticed); a refusal doubts, too.
nlohmann::json noticed_row(const ReadMammogram& read, const MammogramImage& image);

/// How many rows are right, unsure and wrong: skin within 3 mm, nipple and pectoral edge within 5;
/// and what errors are over their standard deviations.
nlohmann::json mammogram_counts(const nlohmann::json& rows);

/// Writes {"counts", "cases"} as the main product, commits, and prints the counts.
void commit_counted(const nlohmann::json& counts, const nlohmann::json& cases, Products& products);

}  // namespace mammotwin
