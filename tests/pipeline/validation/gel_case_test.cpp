#include <nlohmann/json.hpp>

#include "pipeline/validation/gel_result.h"
#include "tests/pipeline/scratch_folder.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

const std::filesystem::path kGelCases =
    std::filesystem::path(MAMMOTWIN_SOURCE_DIR) / "sample_data/gel_cylinder";

TEST(GelCase, EveryFileOfTheSampleDataReads) {
  for (const std::string name : {"lateral", "plane_strain", "axial", "bonded"}) {
    const GelCase c = read_gel_case(kGelCases / (name + ".toml"));
    EXPECT_EQ(c.name, name);
    EXPECT_TRUE(c.force_N && c.force_target) << name;
    EXPECT_EQ(c.experiment.elements.square % 2, 0) << name;
  }
}

using GelCaseFile = ScratchFolder;

TEST_F(GelCaseFile, UnknownKeyIsRefusedWithTheNearestOne) {
  const auto file = write("lateral.toml", "case = \"lateral\"\n[reference]\nforce_n = 8\n");
  try {
    read_gel_case(file);
    FAIL();
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("lateral.toml"), std::string::npos) << error.what();
    EXPECT_NE(std::string(error.what()).find("did you mean reference.force_N"), std::string::npos)
        << error.what();
  }
}

// Coarse and off by more than the target: what is missed is said, and the keys that others read
// stand where design, section 1, has them.
TEST(GelResult, HasTheKeysOfTheDesignAndSaysWhatItMisses) {
  GelCase c = read_gel_case(kGelCases / "axial.toml");
  c.force_N = 2 * *c.force_N;
  const GelResult result = run_gel_case(c, [](const std::string&) {});
  const nlohmann::json entry = to_json(result);
  for (const char* key : {"force_N", "half_width_middle_mm", "half_width_end_mm",
                          "half_length_axis_mm", "radial_stretch"}) {
    EXPECT_TRUE(entry.at(key).is_number()) << key;
    EXPECT_TRUE(entry.at("reference").at(key).is_number()) << key;
    EXPECT_TRUE(entry.at("relative_error").at(key).is_number()) << key;
  }
  EXPECT_TRUE(entry.at("seconds").is_number());
  EXPECT_EQ(entry.at("dof"), result.figures.dof);
  EXPECT_NEAR(entry.at("relative_error").at("force_N").get<double>(), -0.5, 1e-4);
  const nlohmann::json rows = mesh_rows(result);
  ASSERT_EQ(rows.size(), result.study.size() + 1);
  EXPECT_EQ(rows.back().at("mesh"), "recommended");
  EXPECT_NEAR(rows.back().at("force_off_percent").get<double>(), -50, 1e-2);
  EXPECT_NEAR(rows.back().at("half_width_off_mm").get<double>(), 0, 1e-3);
  ASSERT_EQ(missed_targets(result).size(), 1u);
  EXPECT_EQ(missed_targets(result)[0].rfind("axial: force is off by -50", 0), 0u)
      << missed_targets(result)[0];
}

}  // namespace
}  // namespace mammotwin
