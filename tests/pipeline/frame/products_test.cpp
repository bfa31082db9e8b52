#include "pipeline/frame/products.h"

#include <sys/wait.h>
#include <unistd.h>

#include "tests/pipeline/scratch_folder.h"

namespace mammotwin {
namespace {

using ProductsTest = ScratchFolder;

void fill(const std::filesystem::path& path, const std::string& text) {
  std::ofstream(path) << text;
}

TEST_F(ProductsTest, AppearOnlyWhenCommitted) {
  Products products(folder_ / "new" / "prone.vtu");
  fill(products.write_main(), "mesh");
  fill(products.write("prone.exf"), "exf");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "new" / "prone.vtu"));
  products.commit();
  EXPECT_EQ(text_of(folder_ / "new" / "prone.vtu"), "mesh");
  EXPECT_EQ(text_of(folder_ / "new" / "prone.exf"), "exf");
}

TEST_F(ProductsTest, LeaveNothingBehindWhenAbandoned) {
  {
    Products products(folder_ / "prone.vtu");
    fill(products.write_main(), "half");
  }
  EXPECT_TRUE(std::filesystem::is_empty(folder_));
}

TEST_F(ProductsTest, AbandonedKeepTheProductThatWasThere) {
  write("prone.vtu", "old");
  {
    Products products(folder_ / "prone.vtu");
    fill(products.write_main(), "half");
  }
  EXPECT_EQ(text_of(folder_ / "prone.vtu"), "old");
}

TEST_F(ProductsTest, RemoveWhatAKilledRunLeft) {
  // Process numbers end at 4194304 (Linux, PID_MAX_LIMIT), so none can be alive with this one.
  write(".partial-99999999-prone.vtu", "half");
  Products products(folder_ / "prone.vtu");
  products.write_main();
  EXPECT_FALSE(std::filesystem::exists(folder_ / ".partial-99999999-prone.vtu"));
}

// A killed process stays in /proc until its parent asks after it.
TEST_F(ProductsTest, RemoveWhatAKilledRunLeftThatNobodyHasAskedAfter) {
  const pid_t child = fork();
  if (child == 0) _exit(0);
  siginfo_t info{};
  waitid(P_PID, child, &info, WEXITED | WNOWAIT);  // ended, and kept as a zombie
  const std::string left = ".partial-" + std::to_string(child) + "-prone.vtu";
  const std::string own = ".partial-" + std::to_string(getppid()) + "-prone.vtu";
  write(left, "half");
  write(own, "half");  // of a process that is alive
  Products products(folder_ / "prone.vtu");
  products.write_main();
  EXPECT_FALSE(std::filesystem::exists(folder_ / left));
  EXPECT_TRUE(std::filesystem::exists(folder_ / own));
  waitpid(child, nullptr, 0);
}

TEST_F(ProductsTest, AFolderThatCannotBeMadeIsNamed) {
  write("file", "");
  const std::string message = message_of([&] { Products(folder_ / "file" / "042" / "a.vtu"); });
  EXPECT_NE(message.find("file/042: the results folder cannot be written"), std::string::npos)
      << message;
}

}  // namespace
}  // namespace mammotwin
