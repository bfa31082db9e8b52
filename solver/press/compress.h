#pragma once

#include <functional>

#include "solver/press/compression_problem.h"
#include "solver/press/compression_result.h"
#include "solver/progress.h"

namespace mammotwin {

struct CompressionCheckpoint;

/// How a compression that was interrupted goes on (press/checkpoint.h).
struct CompressionRestart {
  const CompressionCheckpoint* from = nullptr;  ///< of the same problem; null: anew
  std::function<void(const CompressionCheckpoint&)>
      keep;  ///< called after each load step, but for those of a second press; or empty
};

/// Squeezes the breast between support and paddle to the thickness asked, or until the paddle
/// presses with the most force.
///
/// Throws std::invalid_argument that names the cause where the problem cannot be posed: folded
/// mesh, stiffness not positive, a number that is not finite, a thickness that is not between 0 and
/// the breast's, plates that never touch, nothing that holds the body. Where no equilibrium is
/// found, or none that is stable, and the breast slid backwards, it is pressed again, drawn twice
/// and then four times as hard (`drawn_times`). Otherwise, or where that is no help, it is pressed
/// once more by half as long steps, each nearer to balance and to a stable one, unless it slipped
/// out; what fails then says why and how far the first came.
CompressionResult compress(const CompressionProblem& problem, const CompressionOptions& options,
                           const Progress& progress = {}, const CompressionRestart& restart = {});

/// The same from the result of a slightly different problem on the same mesh (thickness, plates'
/// place, stiffness), in a tenth of the iterations; it stays on that result's branch of equilibria.
/// `energy_force_N` is not computed. Friction holds it as it held that result.
CompressionResult compress_from(const CompressionResult& near, const CompressionProblem& problem,
                                const CompressionOptions& options);

}  // namespace mammotwin
