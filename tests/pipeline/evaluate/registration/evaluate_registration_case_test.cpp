// evaluate-registration from a drawn patient to its line in the table, on few elements.

#include <nlohmann/json.hpp>

#include "tests/pipeline/command.h"
#include "tests/pipeline/scratch_folder.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

using nlohmann::json;

class EvaluateRegistration : public ScratchFolder {
 protected:
  CommandResult run(const std::string& how) {
    return run_command(
        {MAMMOTWIN_BIN "/mammotwin-evaluate-registration", table(), "--synthetic", "1", how});
  }
  std::string table() const { return (folder_ / "registration.json").string(); }
  json row() const { return json::parse(text_of(table())).at("cases").at(0); }
};

// Few elements on both sides: what is asserted is that the search brings marks nearer, and that
// they are judged, not how near they come (pipeline/evaluate/README.md has that, on full meshes).
TEST_F(EvaluateRegistration, BringsMarksNearerAndJudgesThem) {
  const CommandResult done = run("--coarse");
  ASSERT_EQ(done.exit_code, 0) << done.text;
  const json found = row();
  ASSERT_TRUE(found["reason"].is_null()) << found["reason"];
  for (const std::string space : {"cc", "mlo", "3d"}) {
    const double after = found["tre_" + space + "_mm"];
    EXPECT_LT(after, 0.6 * found["before_search_tre_" + space + "_mm"].get<double>()) << space;
    EXPECT_LT(after, 0.6 * found["baseline_tre_" + space + "_mm"].get<double>()) << space;
    EXPECT_EQ(found["errors"]["tre_" + space + "_mm"].size(), 23u) << space;
  }
  ASSERT_EQ(found["marks"].size(), 46u);  // three lesions and 20 points in two views
  for (const json& mark : found["marks"]) EXPECT_GT(mark["covariance_mm2"][0], 0);
  // What lies there is judged again without a solve, and is the same.
  const CommandResult again = run("--judge");
  ASSERT_EQ(again.exit_code, 0) << again.text;
  EXPECT_EQ(row(), found);
}

}  // namespace
}  // namespace mammotwin
