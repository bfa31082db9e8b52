#include "pipeline/evaluate/cases/stage_command.h"

#include <thread>
#include <vector>

#include "segmentation/image/label_components.h"
#include "tests/pipeline/scratch_folder.h"

namespace mammotwin {
namespace {

class StageCommand : public ScratchFolder {};

TEST_F(StageCommand, ProgramsAreStartedByManyThreadsBesideItksOwn) {
  label_components({20, 20, 20}, std::vector<std::uint8_t>(8000, 1));  // starts ITK's threads
  std::vector<std::jthread> threads;
  for (int t = 0; t < 8; ++t)
    threads.emplace_back([&, t] {
      for (int n = 0; n < 20; ++n) {
        const auto log = folder_ / ("log" + std::to_string(t));
        EXPECT_EQ(run_program("/bin/true", {}, log, 10).exit_code, 0);
      }
    });
}

}  // namespace
}  // namespace mammotwin
