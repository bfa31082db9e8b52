// A coarse patient whose DICOM headers name a person, through the real stages: no output tells who
// it is, and a run that is killed and begun again ends as an undisturbed one does.

#include <chrono>

#include "segmentation/files/segmentation_file.h"
#include "tests/pipeline/chain_run.h"
#include "tests/pipeline/kills.h"
#include "tests/pipeline/patient_case.h"
#include "tests/registration/mammogram_dicom.h"
#include "tests/segmentation/files/dicom_writer.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// 042 at 60 % of its size, its voxels averaged to 2.2 x 1.4 x 2.2 mm: what a chain computes grows
/// with the breast's volume and with its voxels, and fit wants 20,000 of them.
const Eigen::Vector3i kCoarser(3, 2, 3);
constexpr double kScale = 0.6;

Volume<float> coarse(const Volume<float>& fine) {
  const Eigen::Vector3d coarser = kCoarser.cast<double>();
  const Eigen::Vector3i size = fine.size.cwiseQuotient(kCoarser);
  const Eigen::Vector3d shift = 0.5 * (coarser - Eigen::Vector3d::Ones());
  Volume<float> image(size, kScale * fine.spacing.cwiseProduct(coarser),
                      kScale * (fine.origin + shift.cwiseProduct(fine.spacing)));
  for (int k = 0; k < size.z() * kCoarser.z(); ++k)
    for (int j = 0; j < size.y() * kCoarser.y(); ++j)
      for (int i = 0; i < size.x() * kCoarser.x(); ++i)
        image(i / kCoarser.x(), j / kCoarser.y(), k / kCoarser.z()) +=
            fine(i, j, k) / kCoarser.prod();
  return image;
}

class CoarsePatient : public PatientCase {
 protected:
  void SetUp() override {
    // Light compression of few elements, and no search: the chain is short, its stages are all
    // there.
    const fs::path folder = patient("c", R"(side = "left"
register.search = false
fit.elements = [4, 4, 1]
[[lesions]]
point_lps_mm = [35.9, -14.5, -8.4]
radius_mm = 4.8
[views.cc]
thickness_mm = 48
[views.mlo]
mammogram = "mlo.dcm"
thickness_mm = 45
)");
    DicomHeader header;
    header.identified = true;
    write_dicom_series(folder / "mri", "", header,
                       coarse(read_image_file(MAMMOTWIN_SOURCE_DIR "/sample_data/042/mri.nrrd")));
    DcmFileFormat mammogram;
    fill_mammogram(*mammogram.getDataset());
    mammogram.getDataset()->putAndInsertString(DCM_PatientID, "PLANTED-ID-4711");
    mammogram.getDataset()->putAndInsertString(DCM_StudyDate, "20010405");
    mammogram.getDataset()->putAndInsertString(DCM_StudyInstanceUID, "1.2.840.99.77.1.4711");
    ASSERT_TRUE(mammogram.saveFile((folder / "mlo.dcm").c_str(), EXS_LittleEndianExplicit).good());
  }
  ChainRun chain() const { return {"c", data(), results()}; }
  void expect_no_planted_word_in(const std::string& text, const std::string& where) const {
    for (const std::string& word : planted_identity())
      EXPECT_EQ(text.find(word), std::string::npos) << where << " tells " << word;
  }
  void expect_nobody_named(const std::string& said);
};

void CoarsePatient::expect_nobody_named(const std::string& said) {
  // The search finds what is there: the input itself names the patient.
  EXPECT_NE(text_of(data() / "c" / "mri" / "0000.dcm").find(planted_identity()[4]),
            std::string::npos);
  expect_no_planted_word_in(said, "what is said");
  int files = 0;
  for (const auto& entry : fs::recursive_directory_iterator(results())) {
    if (!entry.is_regular_file()) continue;
    expect_no_planted_word_in(entry.path().string(), "a file's name");
    expect_no_planted_word_in(text_of(entry.path()), entry.path().filename().string());
    ++files;
  }
  EXPECT_GT(files, 35);  // products, sidecars, page, scene, tables, logs
}

TEST_F(CoarsePatient, IsNamedNowhereAndLosesNothingToKills) {
  const auto start = Clock::now();
  const CommandResult run = chain().run_script("cohort/run_cohort.sh");
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  ASSERT_EQ(run.exit_code, 0) << run.text;
  const auto expected = chain().products();
  ASSERT_TRUE(expected.count("lesions.csv") && expected.count("report.html"));
  EXPECT_NE(expected.at("report.html").find("own L-MLO with the predicted places"),
            std::string::npos);
  const CommandResult scene = chain().run_script("run_patient.sh", "slicer");
  EXPECT_EQ(scene.exit_code, 0) << scene.text;
  expect_nobody_named(run.text + scene.text);

  // A third of a chain apart, so that the longest stage comes through, too.
  if (std::getenv("MAMMOTWIN_KILLS"))
    expect_nothing_lost_to_kills(chain(), num_kills(), 4, seconds / 3, expected);
}

}  // namespace
}  // namespace mammotwin
