#include "solver/press/judge_compressed.h"

#include <algorithm>
#include <cmath>

#include "solver/press/plate_way.h"

namespace mammotwin {

void judge_compressed(Press& press, const LoadSteppingReport& load, const State& state,
                      CompressionReport& report) {
  // What "reached" means: nearer than anything that a breast is asked about. [mm] and of the flow.
  constexpr double most_error = 0.5, most_penetration = 1, most_imbalance = 1e-2;
  const double error = std::abs(report.thickness_mm - report.target_thickness_mm);
  const double apart = press.placed().paddle_height - press.placed().support_height;
  if (report.slipped_out)
    report.reason = "the breast slipped out backwards: the plates stand " + in_mm(apart) +
                    " apart (stiffer chest-wall springs or more friction would hold it)";
  else if (!load.complete())
    report.reason = load.reason;
  else if (error > std::max(most_error, press.options().thickness_tolerance))
    report.reason = "the thickness stays " + in_mm(error) + " off";
  else if (report.max_penetration_mm > most_penetration)
    report.reason = "a point stays " + in_mm(report.max_penetration_mm) + " inside a plate";
  else if (report.imbalance > most_imbalance)
    report.reason = "forces stay out of balance by " +
                    std::to_string(std::lround(100 * report.imbalance)) + " %";
  else if (!press.newton().is_stable(state))
    report.reason = "the equilibrium found is unstable: a breast would not stay in it";
  else
    report.status = CompressionStatus::converged;
  if (!report.usable())
    report.reason = "stopped at " + in_mm(report.thickness_mm) + " of " +
                    in_mm(report.target_thickness_mm) + ": " + report.reason;
}

}  // namespace mammotwin
