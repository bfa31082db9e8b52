#include "pipeline/patient.h"

#include "tests/pipeline/scratch_folder.h"

namespace mammotwin {
namespace {

class PatientTest : public ScratchFolder {
 protected:
  PatientTest() { patient_.declare(settings_); }
  std::string message_of_reading(const std::string& toml) {
    return message_of([&] { patient_.read(write("patient.toml", toml), settings_); });
  }
  Patient patient_;
  Settings settings_;
};

TEST_F(PatientTest, ResolvesPathsFromItsFile) {
  patient_.read(write("patient.toml", ""), settings_);
  EXPECT_EQ(patient_.resolve("mri"), folder_ / "mri");
  EXPECT_EQ(patient_.resolve("/data/mri"), "/data/mri");
}

}  // namespace
}  // namespace mammotwin
