// A loss of power at every fourth step that a stage takes in its results folder, at each with
// MAMMOTWIN_KILLS=1 in the environment: what is left is a product
// as it was, or whole, or none, and the next run ends as an undisturbed one.

#include <cstdlib>

#include "tests/pipeline/faults/fake_stage_folder.h"
#include "tests/pipeline/faults/faults.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

class PowerCut : public FakeStageFolder {
 protected:
  Faults faults() const { return {folder_ / "disk", folder_ / "layer"}; }
};

// What the layer is for: it finds this common way of writing wanting.
TEST_F(PowerCut, TakesWhatWasRenamedAndNotSynced) {
  const std::string disk = (folder_ / "disk").string();
  const std::vector<std::string> shell{
      "sh", "-c", "echo text > " + disk + "/new; mv " + disk + "/new " + disk + "/product"};
  write("disk/product", "old");
  Faults layer = faults();
  layer.run(shell, {});
  EXPECT_GT(layer.steps().all, 0);
  layer.cut_power(AfterPowerCut::entries_as_seen);
  EXPECT_EQ(text_of(disk + "/product"), "") << "its name was kept, its bytes were not";
  write("disk/product", "old");
  layer.run(shell, {});
  layer.cut_power(AfterPowerCut::entries_as_synced);
  EXPECT_EQ(text_of(disk + "/product"), "old");
}

TEST_F(PowerCut, TakesNothingOfAStageThatHasEnded) {
  for (const auto what : {AfterPowerCut::entries_as_seen, AfterPowerCut::entries_as_synced}) {
    fs::remove_all(folder_ / "disk" / "new");
    Faults layer = faults();
    const CommandResult end = layer.run(stage(), {});
    ASSERT_EQ(end.exit_code, 0) << end.text;
    const std::string written = products();
    ASSERT_GT(written.size(), 500000u);
    layer.cut_power(what);
    EXPECT_EQ(products(), written);
    const CommandResult again = run_command(stage());
    EXPECT_NE(again.text.find("up to date"), std::string::npos) << again.text;
  }
}

TEST_F(PowerCut, LeavesAtEveryStepAProductAsItWasOrWhole) {
  ASSERT_EQ(run_command(stage()).exit_code, 0);
  const std::string old_product = products(), old_main = text_of(product());
  fs::copy(folder_ / "disk", folder_ / "old", fs::copy_options::recursive);
  write("a", "another input");
  Faults layer = faults();
  ASSERT_EQ(layer.run(stage(), {}).exit_code, 0);
  const long steps = layer.steps().all;
  const std::string new_product = products(), new_main = text_of(product());
  ASSERT_NE(new_product, old_product);
  ASSERT_GT(steps, 10);
  int killed = 0;
  const long stride = std::getenv("MAMMOTWIN_KILLS") ? 1 : 4;
  for (long step = 1; step <= steps; step += stride)
    for (const auto what : {AfterPowerCut::entries_as_seen, AfterPowerCut::entries_as_synced}) {
      SCOPED_TRACE("step " + std::to_string(step));
      fs::remove_all(folder_ / "disk");
      fs::copy(folder_ / "old", folder_ / "disk", fs::copy_options::recursive);
      killed += layer.run(stage(), {}, step).exit_code == 137;
      layer.cut_power(what);
      const std::string left = text_of(product());
      EXPECT_TRUE(left == new_main || left == old_main) << left.size() << " bytes";
      const CommandResult again = run_command(stage());
      EXPECT_EQ(again.exit_code, 0) << again.text;
      EXPECT_EQ(products(), new_product);
      for (const auto& entry : fs::directory_iterator(product().parent_path()))
        EXPECT_FALSE(entry.path().filename().string().starts_with(".partial-")) << entry.path();
    }
  EXPECT_EQ(killed, 2 * ((steps + stride - 1) / stride));
  std::cerr << "power was cut at " << killed / 2 << " of " << steps
            << " steps, with two file systems\n";
}

}  // namespace
}  // namespace mammotwin
