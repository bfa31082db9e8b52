#include "registration/export/landmark_table.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>

#include "tests/registration/squeezed_box.h"
#include "tests/scratch_file.h"

namespace mammotwin {
namespace {

std::filesystem::path write_pairs(const std::string& lines) {
  const auto path = scratch_file("pairs.csv");
  std::ofstream(path) << "name,mri_l_mm,mri_p_mm,mri_s_mm,cc_column,cc_row,mlo_column,mlo_row\n"
                      << lines;
  return path;
}

struct View {
  SqueezedBox breast;
  Detector detector;
  ViewProjection projection;
  ViewRays rays;

  explicit View(double angle_deg)
      : breast(squeezed_box(Side::left, angle_deg, 0.5)),
        detector{660, 0, PixelGrid{0.1, 2000, 2600, ImageEdge::left}},
        projection(breast.prone, breast.compressed, breast.view, detector),
        rays(breast.prone, breast.compressed, breast.view, detector) {}
};

TEST(LandmarkTable, FindsNoErrorInItsOwnPredictionsAndSaysWhatIsAdded) {
  const View cc(0), mlo(45);
  std::vector<LandmarkPair> pairs;
  for (const Eigen::Vector3d& x : {Eigen::Vector3d(60, -30, 8), Eigen::Vector3d(81, -44, -12)}) {
    const Landmark l{"p", x};
    pairs.push_back({"p",
                     x,
                     {{"cc", *cc.projection.project(l).in_image},
                      {"mlo", *mlo.projection.project(l).in_image}}});
  }
  const std::map<std::string, JudgedView> views = {{"cc", {&cc.projection, &cc.rays}},
                                                   {"mlo", {&mlo.projection, &mlo.rays}}};
  auto errors = target_errors(pairs, views);
  for (const char* name : {"cc", "mlo", "3d"}) {
    ASSERT_EQ(errors[name].with_model.size(), 2u);
    EXPECT_LT(errors[name].with_model[0], 1e-6);  // inverse maps answer to 1e-9 mm
  }
  // The boxes move by the baseline's own law.
  for (const char* name : {"cc", "mlo", "3d"}) EXPECT_LT(errors[name].without_model[0], 1e-6);

  pairs[0].marks["cc"].x() += 40;  // 4 mm on the detector
  errors = target_errors(pairs, views);
  EXPECT_NEAR(errors["cc"].with_model[0], 4, 1e-6);
  EXPECT_NE(target_error_table(errors).find("cc    model              2.00     2.83     2.00"),
            std::string::npos)
      << target_error_table(errors);  // of {4, 0}
}

TEST(LandmarkTable, LeavesOutWhatWasNotFound) {
  const auto pairs = read_landmark_pairs(write_pairs("a,1,2,3,10,20,,\nb,,,,,,5,6\n"));
  ASSERT_EQ(pairs.size(), 2u);
  EXPECT_EQ(pairs[0].marks.count("mlo"), 0u);
  EXPECT_FALSE(pairs[1].mri_in_lps.has_value());
  const View cc(0);
  const auto errors = target_errors(pairs, {{"cc", {&cc.projection, &cc.rays}}});
  EXPECT_EQ(errors.at("cc").with_model.size(), 1u);
  EXPECT_NE(target_error_table(errors).find("no pairs"), std::string::npos);
}

TEST(LandmarkTable, NamesTheCellThatIsWrong) {
  for (const auto& [lines, part] :
       {std::pair("a,1,,3,,,,\n", "line 2: mri_l_mm and its neighbours"),
        std::pair("a,1,2,3,x,4,,\n", "line 2: cc_column is \"x\""),
        std::pair("a,1\n", "line 2 has 2 cells; expected 8")}) {
    try {
      read_landmark_pairs(write_pairs(lines));
      FAIL() << lines;
    } catch (const std::runtime_error& error) {
      EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
    }
  }
}

}  // namespace
}  // namespace mammotwin
