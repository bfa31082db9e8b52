#include <gtest/gtest.h>

#include "pipeline/synthesize/hanging_truth.h"
#include "solver/gravity/hang.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

// The truth of sample_data/042: its unloaded shape, loaded by gravity, is the body that was imaged.
// The forward solve alone says so; what made the shape takes no part.
TEST(HangingTruth, UnloadedSampleHangsAsItWasImaged) {
  PatientOptions options;
  options.anatomy.seed = 42;
  const SyntheticPatient patient = make_patient_without_scan(options);
  const MeshFile truth = read_mesh_file(MAMMOTWIN_SOURCE_DIR "/sample_data/042/truth_unloaded.vtu");
  with_true_breast(patient, truth, [&](const BreastProblem& problem) {
    const HangResult hanging = hang(problem, {});
    ASSERT_TRUE(hanging.report.usable()) << hanging.report.reason;
    EXPECT_GT(hanging.report.sag_max_mm, 3);
    EXPECT_LT(largest_distance(hanging.deformed, problem.prone), 1e-3);
  });
}

}  // namespace
}  // namespace mammotwin
