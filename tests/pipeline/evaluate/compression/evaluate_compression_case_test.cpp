// evaluate-compression from a drawn breast to its lines in the table.

#include <nlohmann/json.hpp>

#include "tests/pipeline/command.h"
#include "tests/pipeline/scratch_folder.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

using nlohmann::json;

class EvaluateCompression : public ScratchFolder {
 protected:
  /// Breast 14: 455 ml, stiffness 1:4.1, pressed by 0.45 and 0.37; a limit of 1 s makes it fail.
  CommandResult run(const std::string& limit) {
    return run_command({MAMMOTWIN_BIN "/mammotwin-evaluate-compression", table(), "--synthetic",
                        "1", "--first", "14", "--limit", limit});
  }
  std::string table() const { return (folder_ / "compression.json").string(); }
  json cases() const { return json::parse(text_of(table())).at("cases"); }
};

TEST_F(EvaluateCompression, LeavesALineForEachViewAndWhatACommandNeeds) {
  const CommandResult killed = run("1");
  ASSERT_EQ(killed.exit_code, 0) << killed.text;
  for (const json& row : cases()) {
    EXPECT_FALSE(row["reached"]);
    EXPECT_EQ(row["reason"], "stopped after 1 s of CPU");
    EXPECT_TRUE(row["newton_iterations"].is_null());
  }
  const auto mesh = folder_ / "compression" / "synthetic-014" / "prone.vtu";
  const auto made = std::filesystem::last_write_time(mesh);

  const CommandResult done = run("3600");
  ASSERT_EQ(done.exit_code, 0) << done.text;
  EXPECT_EQ(std::filesystem::last_write_time(mesh), made) << "the mesh was made a second time";
  ASSERT_EQ(cases().size(), 2u);
  for (const json& row : cases()) {
    for (const char* key : {"name", "side", "view", "compressed_fraction", "min_J",
                            "newton_iterations", "seconds", "reason"})
      EXPECT_TRUE(row.contains(key)) << key;
    EXPECT_TRUE(row["reached"]) << row;
    // 0.1 mm of thickness asked, of a breast over 50 mm.
    EXPECT_NEAR(row["compressed_fraction"].get<double>(), row["target_fraction"].get<double>(),
                0.002);
  }
}

}  // namespace
}  // namespace mammotwin
