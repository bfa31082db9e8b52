#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <ctime>
#include <map>
#include <vector>

#include "tests/benchmarks/cylinder_problem.h"

extern "C" void dgemm_(const char*, const char*, const int*, const int*, const int*, const double*,
                       const double*, const int*, const double*, const int*, const double*, double*,
                       const int*);

namespace mammotwin {

namespace {

/// CPU time of all threads: what other jobs on the machine disturb least [s].
double seconds_of(const auto& work) {
  const std::clock_t begin = std::clock();
  work();
  return double(std::clock() - begin) / CLOCKS_PER_SEC;
}

/// Problems are dear to make; the benchmarks of a size share one.
CylinderProblem& problem(int n) {
  static std::map<int, std::unique_ptr<CylinderProblem>> made;
  auto& p = made[n];
  if (!p) p = std::make_unique<CylinderProblem>(n);
  return *p;
}

using Limit = tbb::global_control;
constexpr auto kThreads = Limit::max_allowed_parallelism;

/// Range 0: mesh; range 1: threads.
void Assembly(benchmark::State& state) {
  CylinderProblem& p = problem(static_cast<int>(state.range(0)));
  const Limit threads(kThreads, state.range(1));
  for (auto _ : state) p.assembler->linearise(p.state, {});
  state.counters["unknowns"] = p.dofs.num_equations();
  state.counters["elements"] = p.model.num_elements();
}

void Factorisation(benchmark::State& state) {
  CylinderProblem& p = problem(static_cast<int>(state.range(0)));
  const Limit threads(kThreads, state.range(1));
  p.assembler->linearise(p.state, {});
  Cholesky cholesky(p.assembler->pattern(), p.dofs.node_of_equation());
  cholesky.factor(p.assembler->matrix());  // the panels' memory is found here
  double best = 1e300;
  for (auto _ : state)
    best = std::min(best, seconds_of([&] { cholesky.factor(p.assembler->matrix()); }));
  const double rate = cholesky.flops() / best * 1e-9;
  state.counters["unknowns"] = p.dofs.num_equations();
  state.counters["Gflop"] = cholesky.flops() * 1e-9;
  state.counters["GF/s"] = rate;
  state.counters["of_dgemm"] = rate / dgemm_rate();  // both a core
}

/// What is left of a Newton iteration: solve, pressures, one balance of the line search.
void Rest(benchmark::State& state) {
  CylinderProblem& p = problem(static_cast<int>(state.range(0)));
  const Limit threads(kThreads, state.range(1));
  p.assembler->linearise(p.state, {});
  Cholesky cholesky(p.assembler->pattern(), p.dofs.node_of_equation());
  cholesky.factor(p.assembler->matrix());
  for (auto _ : state) {
    const Eigen::VectorXd step = cholesky.solve(p.assembler->right_hand_side());
    p.assembler->pressures_after(p.state, p.assembler->nodal_step(step, {}));
    benchmark::DoNotOptimize(p.assembler->balance(p.state).energy);
  }
  state.counters["unknowns"] = p.dofs.num_equations();
}

void sizes(benchmark::internal::Benchmark* b) {
  for (int n : {4, 6, 8, 10, 12})
    for (int threads : {1, 2}) b->Args({n, threads});
  b->Unit(benchmark::kMillisecond)->UseRealTime();
}
BENCHMARK(Assembly)->Apply(sizes);
BENCHMARK(Factorisation)->Apply(sizes);
BENCHMARK(Rest)->Apply(sizes);

void Dgemm(benchmark::State& state) {
  for (auto _ : state) state.counters["GF/s"] = dgemm_rate();
}
BENCHMARK(Dgemm)->Iterations(1);

}  // namespace

double dgemm_rate() {
  static const double rate = [] {
    constexpr int n = 1024, repeats = 20;
    const double one = 1, zero = 0;
    const std::vector<double> A(n * n, 0.5), B(n * n, 0.25);
    std::vector<double> C(n * n);
    double best = 1e300;
    for (int k = 0; k < repeats; ++k)
      best = std::min(best, seconds_of([&] {
                        dgemm_("N", "N", &n, &n, &n, &one, A.data(), &n, B.data(), &n, &zero,
                               C.data(), &n);
                      }));
    return 2.0 * n * n * n / best * 1e-9;
  }();
  return rate;
}

}  // namespace mammotwin
