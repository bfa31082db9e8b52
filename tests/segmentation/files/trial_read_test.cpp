#include "segmentation/files/trial_read.h"

#include <sys/stat.h>
#include <sys/wait.h>

#include <cerrno>
#include <fstream>

#include "segmentation/mri/read_mri.h"
#include "tests/segmentation/files/dicom_writer.h"
#include "tests/segmentation/message.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using std::chrono::milliseconds;

class TrialRead : public testing::Test {
 protected:
  EmptyFolder folder{"trial_read"};

  fs::path write(const std::string& name, const std::string& bytes) {
    std::ofstream(folder.path / name, std::ios::binary) << bytes;
    return folder.path / name;
  }
  fs::path good() { return write("good.dcm", slice()); }
  /// The transfer syntax says that it is 2068 bytes long, in a file of some 1000: GDCM aborts.
  fs::path fatal() {
    std::string bytes = slice();
    bytes[139] = 8;
    return write("fatal.dcm", bytes);
  }
  /// Whoever opens it waits for a writer that never comes, without using the processor.
  fs::path endless(const std::string& name) {
    EXPECT_EQ(mkfifo((folder.path / name).c_str(), 0600), 0);
    return folder.path / name;
  }

 private:
  static std::string slice() {
    return dicom_slice_bytes({}, 0, 4, 4, {0, 0, 0}, 1, std::vector<std::uint16_t>(16, 7));
  }
};

TEST_F(TrialRead, FindsTheFileThatEndsTheProgram) {
  const auto failed = first_fatal(Trial::dicom, {good(), fatal(), good()});
  ASSERT_TRUE(failed);
  EXPECT_EQ(failed->file, 1u);
  EXPECT_FALSE(failed->timed_out);
}

TEST_F(TrialRead, HasNothingAgainstGoodFilesAndExceptions) {
  const fs::path none = folder.path / "none.nrrd";  // ITK throws
  EXPECT_FALSE(first_fatal(Trial::dicom, std::vector<fs::path>(2000, good())));
  EXPECT_FALSE(first_fatal(Trial::raw_header, {none}));
  EXPECT_FALSE(first_fatal(Trial::dicom, {}));
}

// The upper bound tells a limit from none; the machine may be busy.
TEST_F(TrialRead, KillsATrialThatHangs) {
  const auto begin = std::chrono::steady_clock::now();
  const auto dicom = first_fatal(Trial::dicom, {good(), endless("a.dcm")}, milliseconds(700));
  const auto raw = first_fatal(Trial::raw_header, {endless("a.nrrd")}, milliseconds(700));
  const auto took = std::chrono::steady_clock::now() - begin;
  ASSERT_TRUE(dicom && raw);
  EXPECT_EQ(dicom->file, 1u);
  EXPECT_EQ(raw->file, 0u);
  EXPECT_TRUE(dicom->timed_out && raw->timed_out);
  EXPECT_GE(took, milliseconds(1400));
  EXPECT_LT(took, std::chrono::seconds(30));
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1);  // no child is left, not even a dead one
  EXPECT_EQ(errno, ECHILD);
}

TEST_F(TrialRead, IsWhatTellsADamagedSeries) {
  fatal();
  expect_mentions(message_of([&] { read_mri(folder.path); }),
                  {"fatal.dcm", "the DICOM library cannot go through it"});
}

}  // namespace
}  // namespace mammotwin
