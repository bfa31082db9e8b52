// A coarse patient whose DICOM headers name a person, through the real stages: no output tells who it
// is, and a run that is killed and begun again ends as an undisturbed one does.

#include "tests/registration/mammogram_dicom.h"

#include "segmentation/segmentation_file.h"
#include "tests/pipeline/kills.h"
#include "tests/pipeline/patient_case.h"
#include "tests/segmentation/dicom_writer.h"

#include <algorithm>
#include <chrono>
#include <iostream>
#include <map>
#include <random>

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
        image(i / kCoarser.x(), j / kCoarser.y(), k / kCoarser.z()) += fine(i, j, k) / kCoarser.prod();
  return image;
}

class CoarsePatient : public PatientCase {
 protected:
  void SetUp() override {
    // Light compression of few elements, and no search: the chain is short, its stages are all there.
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
    write_dicom_series(folder / "mri", "", header, coarse(read_image_file(MAMMOTWIN_SOURCE_DIR "/sample_data/042/mri.nrrd")));
    DcmFileFormat mammogram;
    fill_mammogram(*mammogram.getDataset());
    mammogram.getDataset()->putAndInsertString(DCM_PatientID, "PLANTED-ID-4711");
    mammogram.getDataset()->putAndInsertString(DCM_StudyDate, "20010405");
    mammogram.getDataset()->putAndInsertString(DCM_StudyInstanceUID, "1.2.840.99.77.1.4711");
    ASSERT_TRUE(mammogram.saveFile((folder / "mlo.dcm").c_str(), EXS_LittleEndianExplicit).good());
  }
  std::vector<std::string> environment() const {
    return {"P=c", "DATA=" + data().string(), "RESULTS=" + results().string(), "BIN=" MAMMOTWIN_BIN};
  }
  CommandResult run_script(const std::string& script, const std::string& target = "") const {
    std::vector<std::string> words{MAMMOTWIN_SOURCE_DIR "/pipeline/" + script};
    if (!target.empty()) words.push_back(target);
    return run_command(words, environment());
  }
  void expect_no_planted_word_in(const std::string& text, const std::string& where) const {
    for (const std::string& word : planted_identity())
      EXPECT_EQ(text.find(word), std::string::npos) << where << " tells " << word;
  }
  /// Names and bytes of the products; sidecars hold times.
  std::map<std::string, std::string> products() const {
    std::map<std::string, std::string> bytes;
    if (!fs::exists(results() / "c")) return bytes;
    for (const auto& entry : fs::directory_iterator(results() / "c"))
      if (entry.path().extension() != ".json" || entry.path().stem().extension() == ".mrk")
        bytes[entry.path().filename().string()] = text_of(entry.path());
    return bytes;
  }
  void expect_nobody_named(const std::string& said);
  void expect_the_same_after_a_kill(double moment, const std::map<std::string, std::string>& expected);
};

void CoarsePatient::expect_nobody_named(const std::string& said) {
  // The search finds what is there: the input itself names the patient.
  EXPECT_NE(text_of(data() / "c" / "mri" / "0000.dcm").find(planted_identity()[4]), std::string::npos);
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

void CoarsePatient::expect_the_same_after_a_kill(double moment,
                                                 const std::map<std::string, std::string>& expected) {
  SCOPED_TRACE("killed after " + std::to_string(moment) + " s");
  fs::remove_all(results() / "c");
  run_and_kill_after(moment, {MAMMOTWIN_SOURCE_DIR "/pipeline/run_patient.sh", "patient"}, environment());
  std::map<std::string, fs::file_time_type> finished;
  for (const auto& [name, bytes] : products()) {
    if (name.front() == '.') continue;
    EXPECT_TRUE(bytes == expected.at(name)) << name << " is half-written";
    if (fs::exists(results() / "c" / (name + ".json")))
      finished[name] = fs::last_write_time(results() / "c" / name);
  }
  const CommandResult again = run_script("run_patient.sh", "patient");
  EXPECT_EQ(again.exit_code, 0) << again.text;
  const auto found = products();
  for (const auto& [name, bytes] : expected)
    EXPECT_TRUE(found.count(name) && found.at(name) == bytes) << name << " differs";
  EXPECT_EQ(found.size(), expected.size());
  for (const auto& [name, time] : finished)
    EXPECT_EQ(fs::last_write_time(results() / "c" / name), time) << name << " was made again";
}

// MAMMOTWIN_KILLS=200 kills the chain at 200 random moments, too: an hour.
TEST_F(CoarsePatient, IsNamedNowhereAndLosesNothingToAKill) {
  const auto start = Clock::now();
  const CommandResult run = run_script("cohort/run_cohort.sh");
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  ASSERT_EQ(run.exit_code, 0) << run.text;
  const auto expected = products();
  ASSERT_TRUE(expected.count("lesions.csv") && expected.count("report.html"));
  EXPECT_NE(expected.at("report.html").find("own L-MLO mammogram"), std::string::npos);
  const CommandResult scene = run_script("run_patient.sh", "slicer");
  EXPECT_EQ(scene.exit_code, 0) << scene.text;
  expect_nobody_named(run.text + scene.text);

  std::mt19937 random(1);
  const int kills = std::getenv("MAMMOTWIN_KILLS") ? num_kills() : 0;
  for (int i = 0; i < kills; ++i) {
    const double moment = seconds * static_cast<double>(random()) / std::mt19937::max();
    expect_the_same_after_a_kill(moment, expected);
    std::cerr << "kill " << i + 1 << " of " << kills << ", after " << moment << " of " << seconds << " s\n";
  }
}

}  // namespace
}  // namespace mammotwin
