// Real MRI and real label maps made by others, from the image to lesions.csv, where they are
// present.

#include "tests/pipeline/patient_case.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const fs::path kCases = MAMMOTWIN_CASES;

/// Sensitivities take minutes a patient; one patient has them.
const std::string kNoSearch = "[register]\nsearch = false\n";

class RealPatient : public PatientCase {
 protected:
  void SetUp() override {
    if (!fs::exists(kCases)) GTEST_SKIP() << "no real cases at " << kCases;
  }

  /// patient.toml from the radiologist's contours: a lesion at each centroid.
  void mri(const std::string& name, const std::string& more) {
    const fs::path folder = kCases / ("mimbcd_" + name);
    const json contours = json::parse(std::ifstream(folder / "lesions_radiologist.json"));
    std::string toml = "[mri]\npath = \"" + fs::canonical(folder / "mri").string() + "\"\n";
    for (const json& contour : contours["mri"])
      toml += "[[lesions]]\npoint_lps_mm = " + contour["centroid_lps_mm"].dump() + "\n";
    patient(name, toml + more);
  }
  void label_map(const std::string& name) {
    patient(name, "side = \"left\"\n[labels]\npath = \"" +
                      fs::canonical(kCases / "label_maps" / (name + "_labels.nii.gz")).string() +
                      "\"\nair = [0]\nfat = [1]\nfibroglandular = [2]\nskin = [3]\nmuscle = [4]\n"
                      "lesion = [5, 6]\ntransition = [7]\n" + kNoSearch);
  }
  void expect_positions_in_both_views(const std::string& name) {
    const CommandResult result = run("patient", name);
    ASSERT_EQ(result.exit_code, 0) << result.text;
    const std::string table = text_of(results() / name / "lesions.csv");
    for (const char* view : {",cc,", ",mlo,"})
      EXPECT_NE(table.find(view), std::string::npos) << table;
    for (const char* view : {"cc.vtu", "mlo.vtu"}) {
      const json q = sidecar(name, view)["quality"];
      EXPECT_NEAR(q["thickness_mm"].get<double>(), q["target_thickness_mm"].get<double>(), 0.1);
      EXPECT_LE(q["max_penetration_mm"].get<double>(), 0.1);
    }
  }
};

TEST_F(RealPatient, Mri8af60052) {
  mri("8af60052", "");
  expect_positions_in_both_views("8af60052");
}

TEST_F(RealPatient, Mri6e4da81a) {
  // 196 mm of breast, cut by the field of view at both ends, under plates with sharp edges does not
  // converge at the default thickness; rounder plates farther from the chest wall do.
  mri("6e4da81a", "[compress]\nplate_rounding_mm = 30\nwall_clearance_mm = 30\n" + kNoSearch);
  expect_positions_in_both_views("6e4da81a");
}

TEST_F(RealPatient, TwoPatientsInOneFolderAreRefusedAndListed) {
  const fs::path folder = patient("two", "[mri]\npath = \"mri\"\n") / "mri";
  fs::create_directory(folder);
  for (const std::string name : {"6e4da81a", "8af60052"})
    for (const auto& file :
         fs::directory_iterator(fs::canonical(kCases / ("mimbcd_" + name) / "mri")))
      fs::create_symlink(file.path(), folder / (name + file.path().filename().string()));
  const CommandResult result = run("segment", "two");
  EXPECT_EQ(result.exit_code, 1);
  for (const char* part : {"holds 2 MR series of 2 patients", "series 7", "series 18", "mri.series"})
    EXPECT_NE(result.text.find(part), std::string::npos) << part << "\n" << result.text;
}

TEST_F(RealPatient, LabelMapsOfThreeExams) {
  for (const char* exam : {"Exam_02", "Exam_07", "Exam_15"}) {
    label_map(exam);
    expect_positions_in_both_views(exam);
  }
}

}  // namespace
}  // namespace mammotwin
