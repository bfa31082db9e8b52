// The sample patient, killed as often as MAMMOTWIN_KILLS_042 says over its run.

#include <chrono>
#include <cstdlib>

#include "tests/pipeline/chain_run.h"
#include "tests/pipeline/patient_case.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

using Clock = std::chrono::steady_clock;

class KilledPatient : public PatientCase {};

TEST_F(KilledPatient, LosesNothing) {
  const char* asked = std::getenv("MAMMOTWIN_KILLS_042");
  if (!asked)
    GTEST_SKIP() << "set MAMMOTWIN_KILLS_042=10; it takes twice the chain's time and more";
  const int kills = std::atoi(asked);
  const ChainRun chain{"042", MAMMOTWIN_SOURCE_DIR "/sample_data", results()};
  const auto start = Clock::now();
  const CommandResult run = chain.run_script("run_patient.sh", "patient");
  ASSERT_EQ(run.exit_code, 0) << run.text;
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  std::cerr << "undisturbed: " << seconds << " s\n";
  // One chain, its kills so far apart that the last ones come near its end.
  expect_nothing_lost_to_kills(chain, kills, kills, seconds / kills, chain.products());
}

}  // namespace
}  // namespace mammotwin
