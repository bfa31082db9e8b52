#pragma once

#include <string>

namespace mammotwin {

/// Value that OPENBLAS_CORETYPE should have on this processor, or an empty string where nothing
/// is to be set: the user has set it, or OpenBLAS has no better kernels than its own choice.
/// Kernels round differently: results are bit for bit the same with the same kernels only, and
/// agree within the solver's tolerances otherwise (tests/verification/rounding_test.cpp).
///
/// Debian 12's OpenBLAS 0.3.21 does not know recent Intel cores and falls back to SSE3 kernels, 4
/// to 5 times slower. It reads the variable when the library loads, so a program sets it and runs
/// itself again before main does anything else.
std::string blas_core_type();

/// Kernels that OpenBLAS uses now, for a log or --version.
std::string blas_core_in_use();

/// One thread inside BLAS: parallelism is the solver's own, over elements and the elimination
/// tree in a fixed order, so that results do not depend on the number of threads.
void use_one_blas_thread();

/// Takes the address space that OpenBLAS works in (128 MiB for each thread that calls it), which it
/// keeps: where there is none, it would ask again without end.
/// @throws std::bad_alloc
void reserve_blas_memory();

}  // namespace mammotwin
