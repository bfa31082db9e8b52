#include <benchmark/benchmark.h>
#include <unistd.h>

#include <cstdlib>
#include <iostream>

#include "solver/newton/blas_kernels.h"

/// As the commands do: OpenBLAS reads its core type when it loads, so set it and start again.
int main(int argc, char** argv) {
  const std::string core = mammotwin::blas_core_type();
  if (!core.empty()) {
    setenv("OPENBLAS_CORETYPE", core.c_str(), 1);
    execv("/proc/self/exe", argv);
  }
  mammotwin::use_one_blas_thread();
  std::cerr << "OpenBLAS kernels: " << mammotwin::blas_core_in_use() << "\n";
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
