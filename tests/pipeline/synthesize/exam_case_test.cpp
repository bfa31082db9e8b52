// An exam as a hospital sends it, read as what it is.

#include <nlohmann/json.hpp>

#include "segmentation/mri/read_mri.h"
#include "tests/pipeline/command.h"
#include "tests/pipeline/scratch_folder.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

using nlohmann::json;

class Exam : public ScratchFolder {
 protected:
  static CommandResult run(const std::string& program, const std::vector<std::string>& arguments) {
    std::vector<std::string> all{MAMMOTWIN_BIN "/" + program};
    all.insert(all.end(), arguments.begin(), arguments.end());
    return run_command(all);
  }
  std::string file(const std::string& name) const { return (folder_ / "anna" / name).string(); }
};

TEST_F(Exam, IsReadAsAPatientsWhoseTruthIsKnown) {
  const CommandResult made = run("mammotwin-synthesize-exam", {file(""), "--seed", "42"});
  ASSERT_EQ(made.exit_code, 0) << made.text;

  const Mri mri = read_mri(file("mri"));
  EXPECT_EQ(mri.patient_position, "HFP");
  EXPECT_NEAR(mri.image.spacing.minCoeff(), 1.2, 1e-3);
  const json truth = json::parse(text_of(file("truth.json")));
  for (const json& lesion : truth["lesions"]) {
    const auto& x = lesion["centroid_lps_mm"];
    const Eigen::Vector3d voxel =
        (Eigen::Vector3d(x[0], x[1], x[2]) - mri.image.origin).cwiseQuotient(mri.image.spacing);
    EXPECT_TRUE((voxel.array() > 0).all() &&
                (voxel.array() < mri.image.size.cast<double>().array()).all())
        << lesion;
  }

  for (const char* view : {"cc", "mlo"}) {
    const CommandResult read = run("mammotwin-read-mammogram", {file(std::string(view) + ".dcm")});
    ASSERT_EQ(read.exit_code, 0) << read.text;
    const json said = json::parse(read.text.substr(read.text.find('{')));
    const bool oblique = view == std::string("mlo");
    EXPECT_EQ(said["geometry"]["angle_deg"], oblique ? 45 : 0) << said;
    EXPECT_EQ(said["findings"]["pectoral"].is_null(), !oblique) << said["findings"];
    EXPECT_EQ(said["findings"]["unsure"], json::array()) << said["findings"];
  }

  for (const char* name : {"cc.dcm", "mlo.dcm", "mri/1.dcm"}) {
    const CommandResult said = run_command({"/bin/sh", "-c", "dciodvfy " + file(name)});
    EXPECT_EQ(said.exit_code, 0) << said.text;
    EXPECT_EQ(said.text.find("Error"), std::string::npos) << said.text;
  }
  EXPECT_EQ(run("mammotwin-synthesize-exam", {file("")}).exit_code, 1) << "it is there already";
}

}  // namespace
}  // namespace mammotwin
