// Real MRI and real label maps made by others, from the image to lesions.csv, where they are
// present.

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <iostream>

#include "registration/export/csv.h"
#include "tests/pipeline/patient_case.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

const fs::path kCases = MAMMOTWIN_CASES;

/// Sensitivities take a minute or two a patient; the two that were imaged by MRI have them.
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
                      "lesion = [5, 6]\ntransition = [7]\n" +
                      kNoSearch);
  }
  /// The first lesion of lesions.csv in a view [mm].
  struct Predicted {
    Eigen::Vector2d on_detector;  ///< (u, v)
    double depth_90 = 0;          ///< half of its 90 % ellipse's extent along u
  };
  Predicted predicted(const std::string& name, const std::string& view) const {
    std::ifstream in(results() / name / "lesions.csv");
    std::string line;
    std::getline(in, line);
    const std::vector<std::string> header = csv::cells(line);
    while (std::getline(in, line)) {
      const std::vector<std::string> cells = csv::cells(line);
      const auto cell = [&](const char* key) {
        return cells.at(std::find(header.begin(), header.end(), key) - header.begin());
      };
      if (cell("view") != view) continue;
      const double angle = std::stod(cell("ellipse_angle_deg")) * M_PI / 180;
      return {{std::stod(cell("detector_u_mm")), std::stod(cell("detector_v_mm"))},
              std::hypot(std::stod(cell("ellipse_major_mm")) * std::cos(angle),
                         std::stod(cell("ellipse_minor_mm")) * std::sin(angle))};
    }
    throw std::runtime_error("lesions.csv has no row of " + view);
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
      EXPECT_LE(q["mean_gap_mm"].get<double>(), 0.2);
      EXPECT_LE(q["max_penetration_mm"].get<double>(), 0.5);
    }
  }
};

TEST_F(RealPatient, Mri8af60052) {
  mri("8af60052", "");
  expect_positions_in_both_views("8af60052");
}

// 196 mm of breast, cut by the field of view at both ends. The radiologist's contours of its lesion
// in CC and MLO have no spacing, no image size and no nipple beside them. What they allow:
// - the spacing, from the lesion's size in MRI and in both views (about 0.1 mm);
// - columns are depths from the chest wall's edge of the image, if the left breast's is the left
// one;
// - rows, if both images are equally high: how much higher up the lesion lies in MLO than in CC, by
// as
//   much as the breast is equally centred on both detectors.
// Detectors' edges and breasts' places differ by centimetres between exams (registration/README.md
// has what is measured here), so the limits are two of the standard deviations of such places, 12
// mm sideways, and 15 mm in depth in CC; and the 90 % ellipses, which know how far edges differ,
// hold the radiologist's depths and reach no farther than such edges do: in MLO a shift of 12 mm
// and a turn of a muscle's 11 degrees 70 mm from the nipple, with 6 mm of the model's own and 18 mm
// that this breast swings and rolls, are 26 mm; the ellipse of 90 % is 2.16 times that, and a sixth
// more is left to mechanics.
TEST_F(RealPatient, Mri6e4da81aAgainstItsMammograms) {
  mri("6e4da81a", "[fit]\nelements = [6, 6, 2]\n");  // by default 8 x 8 x 2, in twice the time
  expect_positions_in_both_views("6e4da81a");
  const json contours =
      json::parse(std::ifstream(kCases / "mimbcd_6e4da81a" / "lesions_radiologist.json"));
  const auto size = [](const json& extent) {
    return std::sqrt(extent[0].get<double>() * extent[1].get<double>());
  };
  const json& cc = contours["mg"][0];
  const json& mlo = contours["mg"][1];
  const double spacing =
      size(contours["mri"][0]["size_mm"]) / std::sqrt(size(cc["size_px"]) * size(mlo["size_px"]));
  EXPECT_NEAR(size(cc["size_px"]) / size(mlo["size_px"]), 1, 0.1);  // it is the same lesion
  const Predicted cc_mark = predicted("6e4da81a", "cc"), mlo_mark = predicted("6e4da81a", "mlo");
  const Eigen::Vector2d in_cc = cc_mark.on_detector, in_mlo = mlo_mark.on_detector;
  const auto depth = [&](const json& mark) {
    return spacing * mark["centroid_px"][0].get<double>();
  };
  const double rise =
      spacing * (cc["centroid_px"][1].get<double>() - mlo["centroid_px"][1].get<double>());
  std::cout << "spacing " << spacing << " mm; depth in CC " << in_cc.x() << " (mammogram "
            << depth(cc) << "), in MLO " << in_mlo.x() << " (" << depth(mlo) << "), MLO above CC "
            << in_mlo.y() - in_cc.y() << " (" << rise << ") mm; 90 % of depths within "
            << cc_mark.depth_90 << " and " << mlo_mark.depth_90 << " mm\n";
  EXPECT_NEAR(in_cc.x(), depth(cc), 30);
  EXPECT_NEAR(in_mlo.y() - in_cc.y(), rise, 36);
  EXPECT_NEAR(in_cc.x(), depth(cc), cc_mark.depth_90);
  EXPECT_NEAR(in_mlo.x(), depth(mlo), mlo_mark.depth_90);
  EXPECT_LT(std::max(cc_mark.depth_90, mlo_mark.depth_90), 85);
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
  for (const char* part :
       {"holds 2 MR series of 2 patients", "series 7", "series 18", "mri.series"})
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
