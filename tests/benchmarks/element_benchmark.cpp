#include <benchmark/benchmark.h>

#include <vector>

#include "solver/element/tensor_kernels.h"
#include "tests/benchmarks/cylinder_problem.h"

namespace mammotwin {
namespace {

void TangentBlockKernel(benchmark::State& state) {
  const std::vector<double> coefficients(9 * kPoints, 1.0);
  std::vector<double> block(kFunctions * kFunctions);
  for (auto _ : state)
    for (int pair = 0; pair < 6; ++pair) {
      tangent_block(coefficients.data(), block.data());
      benchmark::DoNotOptimize(block.data());
    }
}
BENCHMARK(TangentBlockKernel)->Unit(benchmark::kMicrosecond);

void evaluate(benchmark::State& state, TangentKind kind) {
  const CylinderProblem problem(1);
  ElementSystem system;
  for (auto _ : state) {
    problem.model.evaluate(0, problem.state, kind, system);
    benchmark::DoNotOptimize(system.residual.data());
  }
}
void ElementResidual(benchmark::State& state) { evaluate(state, TangentKind::none); }
void ElementTangentAndResidual(benchmark::State& state) { evaluate(state, TangentKind::exact); }
BENCHMARK(ElementResidual)->Unit(benchmark::kMicrosecond);
void ElementConvexTangent(benchmark::State& state) { evaluate(state, TangentKind::convex); }
BENCHMARK(ElementTangentAndResidual)->Unit(benchmark::kMicrosecond);
BENCHMARK(ElementConvexTangent)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace mammotwin
