#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "pipeline/evaluate/cases/read_mammogram.h"
#include "pipeline/evaluate/cases/real_breasts.h"

namespace mammotwin {

/// A CC and an MLO mammogram of women who are not the patient.
struct StrangersExam {
  ReadMammogram cc, mlo;
};

/// Each CC that shows its chest wall at the edge of a breast of `side`, with an MLO of that edge
/// and the same pixels, each used once.
std::vector<StrangersExam> strangers_exams(const std::vector<ReadMammogram>& mammograms, Side side);

/// Takes a breast through the stages to both compressions, then registers it with each of the
/// exams, in folders `exam_1`, ... of `folder`. Of each a row a view: name, side, exam, view, file,
/// `search` (register's, of that view), `end` ("refused" where register refuses the mammograms),
/// `status` of the whole and `noticed`: no registration was made. One row with a `reason` where the
/// breast could not be pressed.
void add_stranger_rows(const RealBreast& breast, const std::vector<StrangersExam>& exams,
                       const std::filesystem::path& folder,
                       const std::function<void(const nlohmann::json&)>& add);

}  // namespace mammotwin
