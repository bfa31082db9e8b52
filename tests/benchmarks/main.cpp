#include <benchmark/benchmark.h>
#include <unistd.h>

#include <cstdlib>
#include <iostream>

#include "solver/newton/blas_kernels.h"
#include "tests/benchmarks/case_reporter.h"

/// solver_benchmarks [benchmarks.json] [--benchmark_filter=...]. As the commands do: OpenBLAS reads
/// its core type when it loads, so set it and start again.
int main(int argc, char** argv) {
  const std::string core = mammotwin::blas_core_type();
  if (!core.empty()) {
    setenv("OPENBLAS_CORETYPE", core.c_str(), 1);
    execv("/proc/self/exe", argv);
  }
  mammotwin::use_one_blas_thread();
  std::cerr << "OpenBLAS kernels: " << mammotwin::blas_core_in_use() << "\n";
  benchmark::Initialize(&argc, argv);
  mammotwin::CaseReporter reporter;
  benchmark::RunSpecifiedBenchmarks(&reporter);
  if (argc > 1) reporter.write(argv[1]);
  return 0;
}
