#include "pipeline/frame/products.h"

#include <sys/wait.h>
#include <unistd.h>

#include "pipeline/frame/checkpoint.h"
#include "pipeline/frame/partial_path.h"
#include "pipeline/frame/sidecar.h"
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
  const std::string left = ".partial-99999999-prone.vtu-0123456789abcdef";
  std::filesystem::create_directory(folder_ / left);
  write(left + "/prone.vtu", "half");
  Products products(folder_ / "prone.vtu");
  products.write_main();
  EXPECT_FALSE(std::filesystem::exists(folder_ / left));
}

TEST_F(ProductsTest, AreWrittenWhereNobodyElseCanLayALink) {
  Products products(folder_ / "prone.vtu");
  const auto own = products.write_main().parent_path();
  EXPECT_NE(own, folder_);
  EXPECT_EQ(std::filesystem::status(own).permissions(), std::filesystem::perms::owner_all);
  EXPECT_NE(Products(folder_ / "prone.vtu").write_main().parent_path(), own) << "can be guessed";
}

TEST_F(ProductsTest, ReplaceALinkAndDoNotFollowIt) {
  const auto victim = write("victim", "of another");
  std::filesystem::create_symlink(victim, folder_ / "prone.vtu.json");
  std::filesystem::create_symlink(victim, folder_ / "prone.vtu");
  write_text_atomically(folder_ / "prone.vtu.json", "{}");
  Products products(folder_ / "prone.vtu");
  fill(products.write_main(), "mesh");
  products.commit();
  EXPECT_EQ(text_of(victim), "of another");
  EXPECT_EQ(text_of(folder_ / "prone.vtu.json"), "{}");
  EXPECT_EQ(text_of(folder_ / "prone.vtu"), "mesh");
}

TEST_F(ProductsTest, ANewFileIsNotWrittenThroughALink) {
  std::filesystem::create_symlink(folder_ / "victim", folder_ / "link");
  EXPECT_NE(message_of([&] { write_new_file(folder_ / "link", "text"); }), "");
  EXPECT_FALSE(std::filesystem::exists(folder_ / "victim"));
}

TEST_F(ProductsTest, ACheckpointWithOneChangedBitIsNone) {
  const Checkpoint checkpoint(folder_ / "cc.vtu", {});
  checkpoint.write({1, 2, 3});
  ASSERT_TRUE(checkpoint.read());
  EXPECT_EQ(checkpoint.read()->size(), 3u);
  const std::string whole = text_of(folder_ / ".cc.vtu.checkpoint");
  for (std::size_t at = 0; at < whole.size(); ++at) {
    std::string damaged = whole;
    damaged[at] ^= 1;
    write(".cc.vtu.checkpoint", damaged);
    EXPECT_FALSE(checkpoint.read()) << "byte " << at;
    write(".cc.vtu.checkpoint", whole.substr(0, at));
    EXPECT_FALSE(checkpoint.read()) << "cut to " << at;
  }
}

// A killed process stays in /proc until its parent asks after it.
TEST_F(ProductsTest, RemoveWhatAKilledRunLeftThatNobodyHasAskedAfter) {
  const pid_t child = fork();
  if (child == 0) _exit(0);
  siginfo_t info{};
  waitid(P_PID, child, &info, WEXITED | WNOWAIT);  // ended, and kept as a zombie
  const auto partial_of = [](pid_t pid) {
    return ".partial-" + std::to_string(pid) + "-prone.vtu-0123456789abcdef";
  };
  const std::string left = partial_of(child), own = partial_of(getppid());
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
