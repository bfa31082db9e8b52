#include "pipeline/patient/patient.h"

#include <nlohmann/json.hpp>

#include "pipeline/patient/tissue_presets.h"
#include "tests/pipeline/scratch_folder.h"

namespace mammotwin {
namespace {

class PatientTest : public ScratchFolder {
 protected:
  PatientTest() { patient_.declare(settings_); }

  void read(const std::string& toml) { patient_.read(write("patient.toml", toml), settings_); }
  std::string message_of_reading(const std::string& toml) {
    return message_of([&] { read(toml); });
  }
  void expect_message(const std::string& toml, const std::string& part) {
    const std::string message = message_of_reading(toml);
    EXPECT_NE(message.find("patient.toml"), std::string::npos) << message;
    EXPECT_NE(message.find(part), std::string::npos) << message;
  }

  /// The same for a patient of whom nothing has been read before.
  void expect_message_of_another(const std::string& toml, const std::string& part) {
    Patient patient;
    const std::string message = message_of([&] { patient.read(write("patient.toml", toml)); });
    EXPECT_NE(message.find(part), std::string::npos) << toml << message;
  }

  Patient patient_;
  Settings settings_;
};

TEST_F(PatientTest, ResolvesPathsFromItsFile) {
  read("[mri]\npath = \"scan.nrrd\"\n[nipple]\nmarkups = \"/elsewhere/n.mrk.json\"\n");
  const SegmentInput input = patient_.segment_input();
  EXPECT_EQ(input.mri, folder_ / "scan.nrrd");
  EXPECT_EQ(input.nipple_markups, "/elsewhere/n.mrk.json");
}

TEST_F(PatientTest, TakesTheFolderMriWhereNoImageIsNamed) {
  read("");
  EXPECT_NE(message_of([&] { patient_.segment_input(); }).find("no image"), std::string::npos);
  std::filesystem::create_directory(folder_ / "mri");
  EXPECT_EQ(patient_.segment_input().mri, folder_ / "mri");
}

TEST_F(PatientTest, ALesionsNameIsTextThatCanStandAnywhere) {
  const auto toml = [](const std::string& id) {
    return "[[lesions]]\npoint_lps_mm = [1, 2, 3]\nid = \"" + id + "\"\n";
  };
  for (const char* id :
       {"a\\nb", "a\\tb", "=cmd()", "@x", "-1+1", "a\\u202eb", "\\u0007", "a\\u2028b", "a\\\\b"})
    expect_message_of_another(toml(id), "lesions[0].id");
  expect_message_of_another(toml(std::string(65, 'a')), "longer than 64");
  Patient patient;
  patient.read(write("patient.toml", toml("L 1, upper <outer> \\u00fc")));
}

TEST_F(PatientTest, ADetachedDataFileIsAnInputToo) {
  write("scan.nhdr", "NRRD0004\ntype: short\ndata file: scan.raw\n");
  write("scan.raw", "voxels");
  read("[mri]\npath = \"scan.nhdr\"\n");
  const auto files = patient_.segment_files();
  ASSERT_EQ(files.size(), 2u);
  EXPECT_EQ(files[1], folder_ / "scan.raw");
}

TEST_F(PatientTest, ReadsLesionsInEveryForm) {
  read(
      "side = \"right\"\n[labels]\npath = \"l.nii\"\nfat = [1, 7]\n"
      "[[lesions]]\nid = \"A\"\npoint_lps_mm = [1, 2, 3]\nradius_mm = 6\n"
      "[[lesions]]\nmarkups = \"m.mrk.json\"\n"
      "[[lesions]]\nlabels = \"l.nii\"\nlabel = 5\n");
  const SegmentInput input = patient_.segment_input();
  EXPECT_EQ(input.side, Side::right);
  EXPECT_EQ(input.label_values.at(7), ForeignTissue::fat);
  ASSERT_EQ(input.lesions.size(), 3u);
  EXPECT_EQ(input.lesions[0].id, "A");
  EXPECT_EQ(*input.lesions[0].point_in_lps, Eigen::Vector3d(1, 2, 3));
  EXPECT_EQ(input.lesions[0].radius_mm, 6.0);
  EXPECT_EQ(input.lesions[1].id, "L2");
  EXPECT_EQ(input.lesions[1].markups, folder_ / "m.mrk.json");
  EXPECT_EQ(input.lesions[2].label_value, 5);
}

TEST_F(PatientTest, NamesEveryPathThatLeadsNowhere) {
  for (const Setting& setting : settings_.all()) {
    if (setting.type != "path") continue;
    Patient patient;
    patient.read(write("patient.toml", setting.key + " = \"absent.file\"\n"));
    const std::string message = message_of([&] { patient.require_files(); });
    EXPECT_NE(message.find(setting.key + ": absent.file: no such file"), std::string::npos)
        << setting.key << message;
  }
  write("there.nii", "");
  read("[mri]\npath = \"there.nii\"\n[[lesions]]\nmarkups = \"absent.mrk.json\"\n");
  EXPECT_NE(message_of([&] {
              patient_.require_files();
            }).find("lesions[0].markups: absent.mrk.json: no such file"),
            std::string::npos);
}

TEST_F(PatientTest, AsksForTwoBracketsRoundLesions) {
  expect_message("[lesions]\npoint_lps_mm = [1, 2, 3]\n", "expected [[lesions]] with two brackets");
}

TEST_F(PatientTest, NamesTheNearestKnownKey) {
  expect_message("[mri]\npaht = \"x\"\n",
                 "unknown key mri.paht; the nearest known one is mri.path");
  expect_message("[[lesions]]\npoint_lps = [1, 2, 3]\n",
                 "lesions[0]: unknown key point_lps; the nearest known one is point_lps_mm");
}

TEST_F(PatientTest, RefusesValuesOutOfTypeOrRange) {
  expect_message("side = \"middle\"\n", "expected \"left\" or \"right\"");
  expect_message("[segment]\nskin_thickness_mm = 50\n", "is 50; expected 0.5 to 5 mm");
  expect_message("[[lesions]]\npoint_lps_mm = [1, 2]\n", "expected a list of 3 numbers");
}

TEST_F(PatientTest, WantsOnePlaceForALesion) {
  expect_message("[[lesions]]\nid = \"A\"\n", "says in 0 ways where the lesion is");
  expect_message("[[lesions]]\npoint_lps_mm = [1, 2, 3]\nmarkups = \"m.mrk.json\"\n",
                 "says in 2 ways where the lesion is");
}

TEST_F(PatientTest, RefusesALabelValueWithTwoMeanings) {
  read("[labels]\npath = \"l.nii\"\nfat = [1]\nskin = [1]\n");
  EXPECT_NE(message_of([&] { patient_.segment_input(); }).find("value 1 is given to two tissues"),
            std::string::npos);
}

TEST_F(PatientTest, GravityIsTheHeadersUnlessItIsGiven) {
  EXPECT_EQ(patient_.imaged_pose(""), Pose::prone);
  EXPECT_EQ(patient_.imaged_pose("FFP"), Pose::prone);
  EXPECT_EQ(patient_.imaged_pose("HFS"), Pose::supine);
  read("gravity = \"none\"\n");
  EXPECT_EQ(patient_.imaged_pose("HFS"), Pose::none);
}

TEST_F(PatientTest, AScanIsFreeOfStressUnlessAPoseIsGiven) {
  read("[scan]\npath = \"a.ply\"\n");
  EXPECT_EQ(patient_.imaged_pose(""), Pose::none);
  read("gravity = \"standing\"\n[scan]\npath = \"a.ply\"\n");
  EXPECT_EQ(patient_.imaged_pose(""), Pose::standing);
}

TEST_F(PatientTest, KeepsASeriesIdentifierOutOfTheParameters) {
  read("[mri]\nseries = \"1.2.840.99\"\n");
  const auto parameters = settings_.parameters({"mri."});
  EXPECT_EQ(parameters.dump().find("1.2.840.99"), std::string::npos);
  EXPECT_NE(parameters["mri.series"]["value"], nullptr);
}

TEST_F(PatientTest, TakesAPresetOfTissueAndWhatIsSaidBesides) {
  const nlohmann::json before = settings_.parameters({"materials.", "compress."});
  read("[materials]\npreset = \"real\"\n");
  EXPECT_EQ(settings_.parameters({"materials.", "compress."}), before);
  read("[materials]\npreset = \"neo_hookean_2026\"\n");
  EXPECT_EQ(patient_.compression.fat.law, LawName::neo_hookean);
  EXPECT_EQ(patient_.compression.stiffness_factor, 1);
  read("[materials]\nfat.c1_kpa = 0.5\npreset = \"real\"\n");
  EXPECT_EQ(patient_.compression.fat.c1_kpa, 0.5);
  EXPECT_EQ(patient_.compression.fat.law, LawName::exponential);
  EXPECT_EQ(patient_.compression.lesion.law, LawName::exponential);
  EXPECT_LT(patient_.compression.lesion.most_stiffening, 100);
  EXPECT_LT(patient_.compression.stiffness_factor, 0.5);
  EXPECT_EQ(patient_.compression.boundary.wall_smoothing, 20);
}

TEST_F(PatientTest, TakesEveryPresetOfTissue) {
  for (const Preset& preset : tissue_presets())
    EXPECT_NO_THROW(settings_.assign("", "materials.preset", preset.name)) << preset.name;
  settings_.assign("", "materials.preset", "gel");
  EXPECT_EQ(patient_.compression.lesion.c1_kpa, 3);
  EXPECT_EQ(patient_.compression.fat.law, LawName::neo_hookean);
  EXPECT_FALSE(patient_.compression.skin.on);
}

// Else a second name would leave behind what only the first one sets.
TEST(TissuePresets, NameTheSameSettings) {
  const auto keys_of = [](const Preset& preset) {
    std::vector<std::string> keys;
    for (const auto& [key, value] : preset.values) keys.push_back(key);
    return keys;
  };
  for (const Preset& preset : tissue_presets())
    EXPECT_EQ(keys_of(preset), keys_of(tissue_presets().front())) << preset.name;
}

}  // namespace
}  // namespace mammotwin
