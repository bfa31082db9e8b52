// The synthetic patient of sample_data/ from MRI to lesion positions, against its truth.

#include <Eigen/Core>

#include "fitting/mesh/mesh_file.h"
#include "registration/carry/point_carrier.h"
#include "registration/export/markups.h"
#include "tests/pipeline/patient_case.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

Eigen::Vector3d vector_of(const json& list) {
  return {list[0].get<double>(), list[1].get<double>(), list[2].get<double>()};
}

class Patient042 : public PatientCase {
 protected:
  void SetUp() override {
    fs::create_directories(data());
    fs::copy(MAMMOTWIN_SOURCE_DIR "/sample_data/042", data() / "042", fs::copy_options::recursive);
  }
  json quality(const std::string& product) const { return sidecar("042", product)["quality"]; }

  void expect_truth();
  void expect_sane_unloading();
  void expect_true_unloaded_shape();
  void expect_sane_compression(const std::string& view);
  void expect_marks_carried();
  void expect_read_in_python();
  void expect_nothing_runs_again();
};

void Patient042::expect_truth() {
  const json truth = json::parse(std::ifstream(data() / "042" / "truth.json"));
  const json found = quality("segmentation.seg.nrrd")["lesions"];
  ASSERT_EQ(found.size(), truth["lesions"].size());
  for (std::size_t n = 0; n < found.size(); ++n)
    EXPECT_LE(
        (vector_of(found[n]["centroid_lps_mm"]) - vector_of(truth["lesions"][n]["centroid_lps_mm"]))
            .norm(),
        2.0)
        << "lesion " << n;
  EXPECT_LE(quality("prone.vtu")["skin_rms_mesh_to_data_mm"], 1.0);
  EXPECT_LE(quality("prone.vtu")["skin_rms_data_to_mesh_mm"], 1.0);
  EXPECT_GT(quality("prone.vtu")["min_jacobian_bound"], 0);
  EXPECT_GE(quality("prone.vtu")["covered_fraction"], 0.97);
}

void Patient042::expect_sane_compression(const std::string& view) {
  const json q = quality(view + ".vtu");
  EXPECT_NEAR(q["thickness_mm"].get<double>(), q["target_thickness_mm"].get<double>(), 0.1) << view;
  EXPECT_LE(std::abs(q["volume_change"].get<double>()), 0.01) << view;
  EXPECT_LE(q["mean_gap_mm"], 0.2) << view;
  EXPECT_LE(q["max_penetration_mm"], 0.5) << view;
}

void Patient042::expect_sane_unloading() {
  const json q = quality("unloaded.vtu");
  EXPECT_EQ(q["gravity"], "prone");
  EXPECT_LE(q["round_trip_max_mm"], 1e-6);
  EXPECT_GT(q["sag_max_mm"], 1);
  EXPECT_GT(q["naive_reversal_error_mm"], 1e-3);
  for (const char* state : {"prone", "unloaded", "standing", "supine", "cc", "mlo"}) {
    const fs::path markups = results() / "042" / ("lesions_" + std::string(state) + ".mrk.json");
    EXPECT_TRUE(fs::exists(markups)) << markups;
  }
  const auto supine = read_markups(results() / "042" / "lesions_supine.mrk.json");
  EXPECT_EQ(supine.front().description.rfind("90 %, seen from the nipple: within ", 0), 0u)
      << supine.front().description;
}

/// The unloaded shape recovered from the MRI against the one that the MRI is made to hang from.
void Patient042::expect_true_unloaded_shape() {
  const MeshFile truth = read_mesh_file(data() / "042" / "truth_unloaded.vtu");
  const HermiteMesh true_prone(truth.configurations.at("prone"), truth.mesh.elements());
  const MeshFile found = read_mesh_file(results() / "042" / "unloaded.vtu");
  const PointCarrier unloaded(HermiteMesh(found.configurations.at("prone"), found.mesh.elements()),
                              found.mesh);
  double squares = 0, moved = 0;
  int count = 0;
  for (int e = 0; e < truth.mesh.num_elements(); ++e)
    for (int k = 0; k < 27; ++k) {
      const MeshPoint point{e, Eigen::Vector3d(k % 3, k / 3 % 3, k / 9) / 2};
      const auto carried = unloaded.carry(true_prone.position(point)).in_lps;
      squares += (carried - truth.mesh.position(point)).squaredNorm();
      moved += (true_prone.position(point) - truth.mesh.position(point)).squaredNorm();
      ++count;
    }
  EXPECT_LT(std::sqrt(squares / count), 0.5);
  EXPECT_GT(std::sqrt(moved / count), 1.5);  // without unloading the error would be this
  RecordProperty("rms_mm", std::to_string(std::sqrt(squares / count)));
}

void Patient042::expect_marks_carried() {
  const auto mark = [&](const std::string& v) {
    return run_command(
        {MAMMOTWIN_BIN "/mammotwin-mark", (results() / "042").string(), "--mm", "--cc", "25", v});
  };
  EXPECT_NE(mark("0").text.find("other_view_ellipse"), std::string::npos);
  const CommandResult beside = mark("300");
  EXPECT_EQ(beside.exit_code, 1);
  EXPECT_NE(beside.text.find("the mark on cc lies off the breast"), std::string::npos)
      << beside.text;
}

/// Debian's Python, for it has these packages.
void Patient042::expect_read_in_python() {
  const std::string python = "/usr/bin/python3";
  if (run_command({python, "-c", "import pandas, vtk"}).exit_code != 0) return;
  const CommandResult read =
      run_command({python, MAMMOTWIN_SOURCE_DIR "/examples/load.py", (results() / "042").string()});
  EXPECT_EQ(read.exit_code, 0) << read.text;
  for (const char* part : {"L2  mlo", "CC: ok", "label 11: 2.1 ml", "cc.vtu: "})
    EXPECT_NE(read.text.find(part), std::string::npos) << "no " << part << " in\n" << read.text;
}

void Patient042::expect_nothing_runs_again() {
  const auto before = times_of_change("042");
  const CommandResult again = run("patient", "042");
  EXPECT_EQ(again.exit_code, 0) << again.text;
  EXPECT_EQ(times_of_change("042"), before);
  for (const char* product : {"segmentation.seg.nrrd", "prone.vtu", "unloaded.vtu", "cc.vtu",
                              "mlo.vtu", "lesions.csv", "report.html"})
    EXPECT_NE(again.text.find(std::string(product) + " is up to date"), std::string::npos)
        << again.text;
}

TEST_F(Patient042, FromMriToLesionPositions) {
  const CommandResult first = run("patient", "042");
  ASSERT_EQ(first.exit_code, 0) << first.text;
  EXPECT_NE(first.text.find("Predicted lesion positions"), std::string::npos);
  expect_truth();
  expect_sane_unloading();
  expect_true_unloaded_shape();
  expect_sane_compression("cc");
  expect_sane_compression("mlo");

  const std::string table = text_of(results() / "042" / "lesions.csv");
  for (const char* row : {"042,L1,cc,", "042,L1,mlo,", "042,L2,cc,", "042,L2,mlo,"})
    EXPECT_NE(table.find(row), std::string::npos) << table;

  expect_marks_carried();
  expect_read_in_python();
  expect_nothing_runs_again();
}

}  // namespace
}  // namespace mammotwin
