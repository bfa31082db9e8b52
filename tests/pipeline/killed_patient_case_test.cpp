// The sample patient, killed as often as MAMMOTWIN_KILLS_042 says, at random moments of its stages.

#include <cstdlib>

#include "tests/pipeline/killed_chain.h"
#include "tests/pipeline/patient_case.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

class KilledPatient : public PatientCase {};

TEST_F(KilledPatient, LosesNothing) {
  const char* asked = std::getenv("MAMMOTWIN_KILLS_042");
  if (!asked)
    GTEST_SKIP() << "set MAMMOTWIN_KILLS_042=50; it takes some seven times what the chain takes";
  KilledChain killed({"042", MAMMOTWIN_SOURCE_DIR "/sample_data", results()}, folder_ / "layer",
                     "042");
  killed.kill_at_moments(per_stage(std::atoi(asked)));
}

}  // namespace
}  // namespace mammotwin
