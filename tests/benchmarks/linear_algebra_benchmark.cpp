#include <benchmark/benchmark.h>
#include <omp.h>
#include <suitesparse/cholmod.h>
#include <tbb/global_control.h>

#include <algorithm>
#include <ctime>
#include <map>
#include <vector>

#include "tests/benchmarks/cylinder_problem.h"

extern "C" void dgemm_(const char*, const char*, const int*, const int*, const int*, const double*,
                       const double*, const int*, const double*, const int*, const double*, double*,
                       const int*);
extern "C" void openblas_set_num_threads(int);

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
  state.counters["gflop"] = cholesky.flops() * 1e-9;
  state.counters["gflops"] = rate;
  state.counters["of_dgemm"] = rate / dgemm_rate();  // both a core
}

/// CHOLMOD on the same matrix: supernodes, of METIS's order and its own nested dissection the one
/// with the sparser factor.
class Cholmod {
 public:
  Cholmod(const SparsePattern& pattern, const std::vector<double>& values) {
    cholmod_start(&common_);
    common_.supernodal = CHOLMOD_SUPERNODAL;
    common_.nmethods = 2;
    common_.method[0].ordering = CHOLMOD_METIS;
    common_.method[1].ordering = CHOLMOD_NESDIS;
    const auto n = static_cast<std::size_t>(pattern.num_columns());
    matrix_ =
        cholmod_allocate_sparse(n, n, values.size(), 1, 1, kLowerTriangle, CHOLMOD_REAL, &common_);
    std::copy(pattern.starts.begin(), pattern.starts.end(), static_cast<int*>(matrix_->p));
    std::copy(pattern.rows.begin(), pattern.rows.end(), static_cast<int*>(matrix_->i));
    std::copy(values.begin(), values.end(), static_cast<double*>(matrix_->x));
    factor_ = cholmod_analyze(matrix_, &common_);
  }
  ~Cholmod() {
    cholmod_free_factor(&factor_, &common_);
    cholmod_free_sparse(&matrix_, &common_);
    cholmod_finish(&common_);
  }
  Cholmod(const Cholmod&) = delete;

  void factor() { cholmod_factorize(matrix_, factor_, &common_); }
  double flops() const { return common_.fl; }

  Eigen::VectorXd solve(Eigen::VectorXd right) {
    cholmod_dense b{};
    b.nrow = b.nzmax = b.d = static_cast<std::size_t>(right.size());
    b.ncol = 1;
    b.x = right.data();
    b.xtype = CHOLMOD_REAL;
    b.dtype = CHOLMOD_DOUBLE;
    cholmod_dense* x = cholmod_solve(CHOLMOD_A, factor_, &b, &common_);
    right = Eigen::Map<Eigen::VectorXd>(static_cast<double*>(x->x), right.size());
    cholmod_free_dense(&x, &common_);
    return right;
  }

 private:
  static constexpr int kLowerTriangle = -1;
  cholmod_common common_;
  cholmod_sparse* matrix_ = nullptr;
  cholmod_factor* factor_ = nullptr;
};

/// Where Cholesky has TBB's threads, CHOLMOD has BLAS's and OpenMP's.
void CholmodFactorisation(benchmark::State& state) {
  CylinderProblem& p = problem(static_cast<int>(state.range(0)));
  const int threads = static_cast<int>(state.range(1));
  openblas_set_num_threads(threads);
  omp_set_max_active_levels(threads > 1 ? 1 : 0);
  p.assembler->linearise(p.state, {});
  Cholmod cholmod(p.assembler->pattern(), p.assembler->matrix());
  cholmod.factor();
  double best = 1e300;
  for (auto _ : state) best = std::min(best, seconds_of([&] { cholmod.factor(); }));
  openblas_set_num_threads(1);
  Cholesky own(p.assembler->pattern(), p.dofs.node_of_equation());
  own.factor(p.assembler->matrix());
  const Eigen::VectorXd x = own.solve(p.assembler->right_hand_side());
  const Eigen::VectorXd y = cholmod.solve(p.assembler->right_hand_side());
  const double rate = cholmod.flops() / best * 1e-9;
  state.counters["unknowns"] = p.dofs.num_equations();
  state.counters["gflop"] = cholmod.flops() * 1e-9;
  state.counters["gflops"] = rate;
  state.counters["of_dgemm"] = rate / dgemm_rate();
  state.counters["off_ours"] = (x - y).norm() / x.norm();  // rounding only
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
  b->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
}
BENCHMARK(Assembly)->Apply(sizes);
BENCHMARK(Factorisation)->Apply(sizes);
BENCHMARK(CholmodFactorisation)->Apply(sizes);
BENCHMARK(Rest)->Apply(sizes);

void Dgemm(benchmark::State& state) {
  for (auto _ : state) state.counters["gflops"] = dgemm_rate();
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
