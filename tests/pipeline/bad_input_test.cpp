#include <sys/mount.h>
#include <unistd.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "fitting/mesh/mesh_file.h"
#include "tests/pipeline/patient_case.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

/// A breast that needs no image: half an ellipsoid of fat on a slab of muscle, with a skin, in 2 mm
/// voxels, as a label map in NRRD. Labels: 1 fat, 3 skin, 4 muscle.
std::string dome_nrrd() {
  constexpr int nx = 90, ny = 75, nz = 90;
  std::string voxels(nx * ny * nz, '\0');
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const double x = 2 * (i - 44.5), z = 2 * (k - 44.5), y = 2 * (60 - j);
        const double outer = x * x / 3600 + z * z / 3600 + y * y / 6400;
        const double inner = x * x / 3249 + z * z / 3249 + y * y / 5929;
        const bool chest = j >= 56;  // 8 mm of tissue on the muscle, which begins at y = 0
        char label = 0;
        if (chest)
          label = j >= 60 ? 4 : j == 56 && outer > 1 ? 3 : 1;
        else if (outer < 1)
          label = inner < 1 ? 1 : 3;
        voxels[(k * ny + j) * nx + i] = label;
      }
  return "NRRD0004\ntype: uint8\ndimension: 3\nspace: left-posterior-superior\nsizes: 90 75 90\n"
         "space directions: (2,0,0) (0,2,0) (0,0,2)\nkinds: domain domain domain\nencoding: raw\n"
         "space origin: (-89,-120,-89)\n\n" +
         voxels;
}

const std::string kLabels =
    "side = \"left\"\n[labels]\npath = \"dome.nrrd\"\nair = [0]\nfat = [1]\n"
    "skin = [3]\nmuscle = [4]\n";

class BadInput : public PatientCase {
 protected:
  /// The breast without an image, with more lines of patient.toml after it.
  void dome(const std::string& name, const std::string& more) {
    std::ofstream(patient(name, kLabels + more) / "dome.nrrd", std::ios::binary) << dome_nrrd();
  }
  void expect_refused(const std::string& name, const std::vector<std::string>& parts,
                      const std::string& stage = "patient", int code = 1) {
    const CommandResult result = run(stage, name);
    EXPECT_EQ(result.exit_code, code) << result.text;
    for (const std::string& part : parts)
      EXPECT_NE(result.text.find(part), std::string::npos) << "no \"" << part << "\" in\n"
                                                           << result.text;
    EXPECT_FALSE(fs::exists(results() / name / "lesions.csv"));
    expect_no_absolute_path(name);
  }
  /// In what is kept of a run.
  void expect_no_absolute_path(const std::string& name) {
    if (!fs::exists(results() / name)) return;
    for (const auto& entry : fs::directory_iterator(results() / name)) {
      if (entry.path().extension() != ".json") continue;
      const std::string text = text_of(entry.path());
      EXPECT_EQ(text.find(results().parent_path().string()), std::string::npos) << text;
    }
  }
};

TEST_F(BadInput, AMissingImageIsNamed) {
  patient("a", "[mri]\npath = \"none.nii.gz\"\n");
  expect_refused("a", {"none.nii.gz: no such file"});
}

TEST_F(BadInput, AnEmptyFolderIsNamed) {
  fs::create_directory(patient("a", "[mri]\npath = \"mri\"\n") / "mri");
  expect_refused("a", {"mri", "empty"});
}

TEST_F(BadInput, AnUnknownKeyNamesTheNearestOne) {
  dome("a", "[views.cc]\nthicknes_mm = 55\n");
  expect_refused("a",
                 {"patient.toml", "unknown key views.cc.thicknes_mm", "views.cc.thickness_mm"});
}

TEST_F(BadInput, AThicknessOfZeroIsRefusedWithItsRange) {
  dome("a", "[views.cc]\nthickness_mm = 0\n");
  expect_refused("a", {"views.cc.thickness_mm is 0; expected 10 to 200 mm"});
}

TEST_F(BadInput, AThicknessLargerThanTheBreastIsRefused) {
  dome("a", "[fit]\nelements = [4, 4, 1]\n[views.cc]\nthickness_mm = 120\n");
  expect_refused("a", {"120", "mm"});
  EXPECT_EQ(sidecar("a", "cc.vtu")["status"], "refused");
  EXPECT_FALSE(fs::exists(results() / "a" / "cc.vtu"));
  EXPECT_TRUE(fs::exists(results() / "a" / "report.html")) << "the page is still written";
}

TEST_F(BadInput, AStiffnessThatIsNotPositiveIsRefusedWithItsRange) {
  dome("a", "[materials.fat]\nc1_kpa = 0\n");
  expect_refused("a", {"materials.fat.c1_kpa is 0", "0.01 to 1000 kPa"});
  dome("b", "[materials.skin]\nc1_kpa = -3.3\n");
  expect_refused("b", {"materials.skin.c1_kpa is -3.3", "0.01 to 1000 kPa"});
}

TEST_F(BadInput, PlatesThatAreNoneAreRefused) {
  const std::string mesh = "[fit]\nelements = [4, 4, 1]\n";
  dome("a", mesh + "[compress]\npaddle_stl = \"none.stl\"\n");
  expect_refused("a", {"none.stl: no such file"});
  dome("b", mesh + "[compress]\npaddle_stl = \"metres.stl\"\n");
  std::ofstream(data() / "b" / "metres.stl")
      << "solid p\nfacet normal 0 0 1\nouter loop\nvertex 0 -0.1 0\nvertex 0.2 -0.1 0\n"
         "vertex 0.2 0.1 0\nendloop\nendfacet\nendsolid p\n";
  expect_refused("b", {"metres.stl", "is it in mm?"});
  dome("c", mesh + "[compress]\nplate_width_mm = 30\nplate_rounding_mm = 20\n");
  expect_refused("c", {"width is 30", "40"});
}

/// What the solver must not be given, made out of a mesh that is good.
TEST_F(BadInput, MeshesThatCannotBeCompressedAreRefused) {
  dome("a", "[fit]\nelements = [4, 4, 1]\n[views.cc]\nthickness_mm = 60\n");
  ASSERT_EQ(run("fit", "a").exit_code, 0);
  const fs::path folder = results() / "a";
  const MeshFile good = read_mesh_file(folder / "prone.vtu");
  const auto expect_no_view = [&](const MeshFile& mesh, const std::string& part) {
    write_mesh_file(folder / "bad.vtu", mesh);
    const CommandResult result = run_command(
        {MAMMOTWIN_BIN "/mammotwin-compress", "cc", (folder / "segmentation.seg.nrrd").string(),
         (folder / "fractions.nrrd").string(), (folder / "bad.vtu").string(),
         (folder / "cc.vtu").string(), "--patient", (data() / "a" / "patient.toml").string()});
    EXPECT_EQ(result.exit_code, 1) << result.text;
    EXPECT_NE(result.text.find(part), std::string::npos) << result.text;
    EXPECT_FALSE(fs::exists(folder / "cc.vtu"));
  };
  const auto with_nodes = [&](const std::vector<HermiteMesh::Node>& nodes) {
    MeshFile mesh = good;
    mesh.mesh = HermiteMesh(nodes, good.mesh.elements());
    return mesh;
  };
  auto nodes = good.mesh.nodes();
  std::swap(nodes[6], nodes[7]);
  expect_no_view(with_nodes(nodes), "folded");
  nodes = good.mesh.nodes();
  for (auto& node : nodes) node.row(0) *= -1;  // a mirror image: inverted
  expect_no_view(with_nodes(nodes), "folded");
  MeshFile loose = good;
  for (auto& labels : loose.faces)
    for (auto& label : labels)
      if (label == FaceLabel::chest_wall) label = FaceLabel::interior;
  expect_no_view(loose, "chest_wall");
}

TEST_F(BadInput, ALesionOutsideTheBreastIsRefused) {
  dome("a", "[[lesions]]\npoint_lps_mm = [0, -200, 0]\nradius_mm = 6\n");
  expect_refused("a", {"L1", "outside"}, "segment");
}

// Lesions 2 cm from each other, in cm: two spheres 0.2 mm apart, of which the larger stays.
TEST_F(BadInput, PointsInCentimetresAreAskedAbout) {
  patient("a", "side = \"left\"\n[mri]\npath = \"" MAMMOTWIN_SOURCE_DIR
               "/sample_data/042/mri.nrrd\"\n"
               "[[lesions]]\npoint_lps_mm = [56.2, -23.1, -14.9]\nradius_mm = 3\n"
               "[[lesions]]\npoint_lps_mm = [56.4, -23.1, -14.9]\nradius_mm = 8\n");
  expect_refused("a", {"lesion L1 is covered by another one", "is their place in cm?"}, "segment");
}

TEST_F(BadInput, AMammogramThatIsNotThereIsNamedBeforeAnythingRuns) {
  dome("a", "[views.cc]\nmammogram = \"cc.dcm\"\n");
  expect_refused("a", {"views.cc.mammogram: cc.dcm: no such file"});
  EXPECT_FALSE(fs::exists(results() / "a" / "segmentation.seg.nrrd"));
}

TEST_F(BadInput, APageThatCannotBeMadeIsNotPointedTo) {
  dome("a", "[views.cc]\nthickness_mm = 5,5\n");
  const CommandResult result = run("patient", "a");
  EXPECT_NE(result.text.find("there is no page of it"), std::string::npos) << result.text;
  EXPECT_EQ(result.text.find("report.html"), std::string::npos) << result.text;
}

TEST_F(BadInput, ATruncatedImageIsNamed) {
  const std::string whole = dome_nrrd();
  const auto folder = patient("a", "[mri]\npath = \"cut.nrrd\"\n");
  std::ofstream(folder / "cut.nrrd", std::ios::binary) << whole.substr(0, whole.size() / 2);
  expect_refused("a", {"cut.nrrd"}, "segment");
}

TEST_F(BadInput, AResultsFolderThatCannotBeWrittenIsNamed) {
  dome("a", "");
  write("results", "a file, where a folder is needed");
  expect_refused("a", {"results folder cannot be written"}, "segment");
}

TEST_F(BadInput, AFullDiskLeavesNothingHalfWritten) {
  if (geteuid() != 0) GTEST_SKIP() << "mounting a small file system needs root";
  dome("a", "");
  fs::create_directories(results());
  if (mount("tmpfs", results().c_str(), "tmpfs", 0, "size=16k") != 0)
    GTEST_SKIP() << "a small file system cannot be mounted here";
  const CommandResult result = run("segment", "a");
  bool partial = false;
  for (const auto& entry : fs::recursive_directory_iterator(results()))
    partial |= entry.path().filename().string().rfind(".partial-", 0) == 0;
  const bool product = fs::exists(results() / "a" / "segmentation.seg.nrrd") ||
                       fs::exists(results() / "a" / "fractions.nrrd");
  umount2(results().c_str(), MNT_DETACH);
  EXPECT_EQ(result.exit_code, 1) << result.text;
  EXPECT_FALSE(partial) << "a temporary file was left";
  EXPECT_FALSE(product) << "a product came of a disk that was full";
}

// At every limit a stage ends in time, done or with words that say what it lacks.
TEST_F(BadInput, TooLittleMemoryIsSaidAndLeavesNothingHalfWritten) {
  dome("a", "[fit]\nelements = [4, 4, 1]\n[views.cc]\nthickness_mm = 60\n");
  ASSERT_EQ(run("fit", "a").exit_code, 0);
  const std::string from = (results() / "a").string() + "/",
                    to = (folder_ / "short").string() + "/";
  const std::string labels = from + "segmentation.seg.nrrd", tissue = from + "fractions.nrrd";
  const std::vector<std::vector<std::string>> stages{
      {"segment", to + "segmentation.seg.nrrd"},
      {"fit", labels, tissue, to + "prone.vtu"},
      {"unload", labels, tissue, from + "prone.vtu", to + "unloaded.vtu"},
      {"compress", "cc", labels, tissue, from + "prone.vtu", to + "cc.vtu"},
      {"report", from, to + "report.html"}};
  int refused = 0;
  for (const auto& stage : stages)
    for (const int megabytes : {190, 195, 200, 205, 210, 250, 300, 500}) {
      SCOPED_TRACE(stage[0] + " with " + std::to_string(megabytes) + " MB");
      fs::remove_all(to);
      std::vector<std::string> words{"timeout", "60", "prlimit", "--core=0",
                                     "--as=" + std::to_string(megabytes) + "000000"};
      words.push_back(MAMMOTWIN_BIN "/mammotwin-" + stage[0]);
      words.insert(words.end(), stage.begin() + 1, stage.end());
      words.insert(words.end(), {"--patient", (data() / "a" / "patient.toml").string()});
      const CommandResult result = run_command(words);
      if (result.text.find("error while loading shared libraries") != std::string::npos) continue;
      if (result.exit_code == 0) continue;
      ++refused;
      EXPECT_EQ(result.exit_code, 1) << result.text;
      EXPECT_NE(result.text.find("not enough memory"), std::string::npos) << result.text;
      std::error_code none;
      for (const auto& entry : fs::directory_iterator(to, none))
        EXPECT_EQ(entry.path().extension(), ".json") << entry.path();
    }
  EXPECT_GE(refused, 10);
}

}  // namespace
}  // namespace mammotwin
