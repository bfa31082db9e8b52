#pragma once

#include "solver/press/compress.h"

namespace mammotwin {

/// The plates close on the breast once; `compress` says how often that is done, and how. The
/// problem has been checked (check_shape). A breast that keeps less than `let_go_below` of the
/// tissue in front of the plates' edges is let go where it finds no rest (finish.h), and counts as
/// slipped out; 0: none is.
CompressionResult press_once(const CompressionProblem& problem, const CompressionOptions& options,
                             double let_go_below, const Progress& progress = {},
                             const CompressionRestart& restart = {});

/// compress_from, of a problem that has been checked.
CompressionResult press_from(const CompressionResult& near, const CompressionProblem& problem,
                             const CompressionOptions& options);

}  // namespace mammotwin
