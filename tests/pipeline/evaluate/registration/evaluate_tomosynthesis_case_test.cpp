// evaluate-tomosynthesis from a drawn patient to the slices of its lesions, on few elements.

#include <nlohmann/json.hpp>

#include "tests/pipeline/command.h"
#include "tests/pipeline/scratch_folder.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

using nlohmann::json;

class EvaluateTomosynthesis : public ScratchFolder {};

// How near they come on full meshes stands in docs/measured/tomosynthesis.md.
TEST_F(EvaluateTomosynthesis, FindsEachLesionInBothViewsNearItsSlice) {
  const std::string table = (folder_ / "tomosynthesis.json").string();
  const CommandResult done =
      run_command({MAMMOTWIN_BIN "/mammotwin-evaluate-tomosynthesis", table, "--coarse"});
  ASSERT_EQ(done.exit_code, 0) << done.text;
  const json rows = json::parse(text_of(table)).at("cases");
  ASSERT_EQ(rows.size(), 4u);
  for (const json& row : rows) {
    EXPECT_LT(row["slice_mm"], 8) << row;
    EXPECT_LT(row["mark_mm"], 8) << row;
  }
}

}  // namespace
}  // namespace mammotwin
