#include <benchmark/benchmark.h>

#include "pipeline/validation/gel_cylinder/gel_cylinder.h"

namespace mammotwin {
namespace {

/// The whole of the lateral case, mesh and figures included, one load step from 29 to 17 mm. CPU
/// time is that of all threads. Other codes' times: README.md.
void squeeze(benchmark::State& state, const CylinderElements& elements) {
  CylinderExperiment experiment;
  experiment.elements = elements;
  CylinderFigures f;
  for (auto _ : state) f = squeeze_cylinder(experiment);
  constexpr double reference_N = 8.515;  // sample_data/gel_cylinder
  state.counters["unknowns"] = f.dof;
  state.counters["iterations"] = f.iterations;
  state.counters["force_error_percent"] = 100 * (f.force_N / reference_N - 1);
  if (!f.usable) state.SkipWithError(f.reason.c_str());
}

void LateralToOnePercent(benchmark::State& state) { squeeze(state, {4, 1, 2}); }
void LateralToThreePerMille(benchmark::State& state) { squeeze(state, {6, 1, 2}); }
void LateralRecommended(benchmark::State& state) { squeeze(state, {6, 1, 4}); }
void LateralToOnePerMille(benchmark::State& state) { squeeze(state, {8, 2, 5}); }

void whole(benchmark::internal::Benchmark* b) {
  b->Unit(benchmark::kMillisecond)->MeasureProcessCPUTime()->UseRealTime();
}
BENCHMARK(LateralToOnePercent)->Apply(whole);
BENCHMARK(LateralToThreePerMille)->Apply(whole);
BENCHMARK(LateralRecommended)->Apply(whole);
BENCHMARK(LateralToOnePerMille)->Apply(whole);

}  // namespace
}  // namespace mammotwin
