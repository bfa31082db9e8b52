#include <gtest/gtest.h>

#include "pipeline/validation/gel_cylinder/gel_cylinder.h"

namespace mammotwin::energy_balance_test {
namespace {

// The plates' work is the stored energy. Work by the trapezoidal rule over the load steps errs by
// (steps)⁻² of the force's curvature; 32 steps leave 0.1 %.
TEST(EnergyBalance, WorkOfThePlatesIsStored) {
  CylinderExperiment experiment;
  experiment.how = CylinderCase::bonded;
  experiment.elements = even_elements(1);
  experiment.thickness = 32;
  experiment.steps = 32;
  const auto f = squeeze_cylinder(experiment);
  ASSERT_TRUE(f.usable) << f.reason;
  EXPECT_NEAR(f.plate_work_mJ / f.stored_energy_mJ, 1, 1e-3);
}

}  // namespace
}  // namespace mammotwin::energy_balance_test
