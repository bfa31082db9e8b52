#include "pipeline/evaluate/registration/misfit_case.h"

#include <nlohmann/json.hpp>

#include "pipeline/evaluate/registration/spoilt_case.h"
#include "registration/mammogram/mammogram_picture.h"
#include "tests/pipeline/scratch_folder.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

/// 40 x 30 pixels, a breast on one edge whose upper half is brighter by `grey`.
MammogramImage picture(float grey, bool wall_at_left) {
  MammogramImage image{40, 30, std::vector<float>(40 * 30, 0)};
  for (int row = 5; row < 25; ++row)
    for (int depth = 1; depth < 20; ++depth)  // the outermost column is dark
      image.at(wall_at_left ? depth : 39 - depth, row) = 20000 + (row < 15 ? grey : 0);
  return image;
}

class MisfitCase : public ScratchFolder {
 protected:
  MisfitCase() {
    for (const std::string name : {"own", "another"}) fs::create_directories(folder_ / name);
    const auto put = [&](const std::string& file, float grey, bool wall_at_left) {
      write_grey(folder_ / file, picture(grey, wall_at_left));
    };
    put("own/cc.png", 1000, true), put("own/mlo.png", 2000, true);
    put("another/cc.png", 3000, false), put("another/mlo.png", 4000, false);
    write("own/patient.toml", "side = \"left\"\n");
    write("own/landmarks.csv",
          "name,mri_l_mm,mri_p_mm,mri_s_mm,cc_column,cc_row,mlo_column,mlo_row\n"
          "L1,1,2,3,10,6.5,12,20\n");
  }
  fs::path made(const std::string& misfit) const {
    make_misfit_case(folder_ / "own", folder_ / "another", misfit, folder_ / misfit);
    return folder_ / misfit;
  }
  static float grey(const fs::path& folder, const char* view, int column, int row) {
    return read_mammogram_picture(folder / view).at(column, row);
  }
};

TEST_F(MisfitCase, AnotherPatientsMammogramsLieOnTheSameEdge) {
  const fs::path folder = made("another_patient");
  EXPECT_EQ(grey(folder, "cc.png", 2, 10), 23000);
  EXPECT_EQ(grey(folder, "mlo.png", 2, 10), 24000);
  EXPECT_EQ(grey(folder, "cc.png", 37, 10), 0);
  EXPECT_EQ(text_of((folder / "landmarks.csv").string()),
            text_of((folder_ / "own/landmarks.csv").string()));
}

TEST_F(MisfitCase, TheOtherBreastLiesOnTheOtherEdge) {
  const fs::path folder = made("other_breast");
  EXPECT_EQ(grey(folder, "cc.png", 37, 10), 21000);
  EXPECT_EQ(grey(folder, "cc.png", 2, 10), 0);
}

TEST_F(MisfitCase, UpsideDownMarksGoWithTheirRows) {
  const fs::path folder = made("upside_down");
  EXPECT_EQ(grey(folder, "cc.png", 2, 10), 20000);
  EXPECT_EQ(grey(folder, "cc.png", 2, 20), 21000);
  EXPECT_NE(text_of((folder / "landmarks.csv").string()).find("L1,1,2,3,10,22.5"),
            std::string::npos);
}

TEST_F(MisfitCase, ViewsAreExchangedWithTheirMarks) {
  const fs::path folder = made("views_exchanged");
  EXPECT_EQ(grey(folder, "cc.png", 2, 10), 22000);
  EXPECT_EQ(grey(folder, "mlo.png", 2, 10), 21000);
  EXPECT_NE(text_of((folder / "landmarks.csv").string()).find("L1,1,2,3,12,20,10,6.5"),
            std::string::npos);
}

TEST_F(MisfitCase, OneWrongMammogramLiesBesideHerOwn) {
  const fs::path turned = made("mlo_upside_down"), exchanged = made("mlo_of_another_patient");
  EXPECT_EQ(grey(turned, "cc.png", 2, 10), 21000);
  EXPECT_EQ(grey(turned, "mlo.png", 2, 20), 22000);
  EXPECT_NE(text_of((turned / "landmarks.csv").string()).find("L1,1,2,3,10,6.5,12,9.0"),
            std::string::npos);
  EXPECT_EQ(grey(exchanged, "cc.png", 2, 10), 21000);
  EXPECT_EQ(grey(exchanged, "mlo.png", 2, 10), 24000);
}

TEST(JudgeMisfit, IsNoticedWhereNothingIsRegisteredOrEllipsesHold) {
  const auto judged = [](const nlohmann::json& reason, const std::string& cc,
                         const std::string& mlo, const nlohmann::json& inside,
                         const std::string& misfit = "upside_down") {
    nlohmann::json row{{"reason", reason}, {"lesions", {{"inside_90", inside}}}};
    if (reason.is_null()) row["search"] = {{"cc", {{"end", cc}}}, {"mlo", {{"end", mlo}}}};
    judge_misfit(misfit, row);
    return row;
  };
  const std::string none = "no registration";
  const std::string refusal = "register: the cc mammogram shows no outline";
  EXPECT_EQ(judged(refusal, "", "", nullptr)["end_cc"], "refused");
  EXPECT_EQ(judged(refusal, "", "", nullptr)["noticed"], true);
  for (const char* failure : {"register: ended with code 139", "segment: no breast"}) {
    EXPECT_EQ(judged(failure, "", "", nullptr)["end_mlo"], "failed");
    EXPECT_EQ(judged(failure, "", "", nullptr)["noticed"], false);
  }
  EXPECT_EQ(judged(nullptr, none, none, 0.5)["noticed"], true);
  EXPECT_EQ(judged(nullptr, none, "look", 0.5)["noticed"], false);
  EXPECT_EQ(judged(nullptr, "look", "ok", 1)["noticed"], true);
  EXPECT_EQ(judged(nullptr, "ok", none, 0.5, "mlo_upside_down")["noticed"], true);
  EXPECT_EQ(judged(nullptr, none, "look", 0.5, "mlo_upside_down")["noticed"], false);
}

}  // namespace
}  // namespace mammotwin
