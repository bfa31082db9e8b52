#include "pipeline/frame/private_names.h"

#include "pipeline/frame/checksum.h"
#include "pipeline/frame/reason.h"
#include "tests/pipeline/scratch_folder.h"

namespace mammotwin {
namespace {

class PrivateNamesTest : public ScratchFolder {
 protected:
  PrivateNamesTest() {
    write("Doe_Jane.dcm", "pixels");
    std::filesystem::create_directories(folder_ / "scan" / "deep");
    write("scan/DOE0001", "slice");
    write("scan/deep/0000123456", "slice");
    write("scan/100", "slice");
    names_.add("cc mammogram", folder_ / "Doe_Jane.dcm");
    names_.add("mri", folder_ / "scan");
  }
  PrivateNames names_;
};

TEST_F(PrivateNamesTest, BecomeRoleAndChecksum) {
  const std::string said = "cc mammogram " + sha256_of_text("pixels").substr(0, 12);
  EXPECT_EQ(names_.without("Doe_Jane.dcm: is cut"), said + ": is cut");
  EXPECT_EQ(names_.without((folder_ / "Doe_Jane.dcm").string() + ": is cut"), said + ": is cut");
  EXPECT_EQ(names_.without("between DOE0001 and 0000123456"),
            "between a file of the mri and a file of the mri");
  EXPECT_EQ(names_.role_of(folder_ / "scan"), "mri");
  EXPECT_EQ(names_.role_of(folder_ / "other"), "");
}

TEST_F(PrivateNamesTest, LeaveWordsAndNumbersThatOnlyContainThem) {
  for (const char* text : {"scanned", "DOE00012", "it has 100 slices of 0.100 mm", "Doe_Jane.dcmx"})
    EXPECT_EQ(names_.without(text), text);
}

TEST_F(PrivateNamesTest, OfAJsonValueChangeItsSentencesAndNoCodes) {
  const nlohmann::json quality{{"notes", {"scan was read"}}, {"code", "scan"}, {"n", 3}};
  EXPECT_EQ(names_.without_in(quality),
            nlohmann::json({{"notes", {"mri was read"}}, {"code", "scan"}, {"n", 3}}));
}

TEST(Role, IsInWords) {
  EXPECT_EQ(role_of_key("views.cc.mammogram"), "cc mammogram");
  EXPECT_EQ(role_of_key("mri.path"), "mri");
  EXPECT_EQ(role_of_key("lesions[0].markups"), "lesions[0] markups");
}

TEST(Reason, IsNoLibrarysWordsForProgrammers) {
  EXPECT_EQ(reason_of(std::runtime_error("a.vtu: is cut")), "a.vtu: is cut");
  const std::string general = reason_of(std::length_error("vector::_M_default_append"));
  EXPECT_NE(general.find("an input holds what"), std::string::npos) << general;
  EXPECT_EQ(reason_of(std::invalid_argument("stod")), general);
  try {
    nlohmann::json(3).at("key");
    FAIL();
  } catch (const std::exception& error) {
    EXPECT_EQ(reason_of(error), general);
  }
}

}  // namespace
}  // namespace mammotwin
