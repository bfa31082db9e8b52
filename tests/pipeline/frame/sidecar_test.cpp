#include "pipeline/frame/sidecar.h"

#include <sys/stat.h>

#include "pipeline/frame/checksum.h"
#include "pipeline/frame/products.h"
#include "tests/pipeline/scratch_folder.h"

namespace mammotwin {
namespace {

TEST(Checksum, IsSha256) {
  // FIPS 180-2, appendix B.1.
  EXPECT_EQ(sha256_of_text("abc"),
            "ba7816bf8f01cfea414140de5dae2223b00361a396177a9cb410ff61f20015ad");
}

class SidecarTest : public ScratchFolder {
 protected:
  SidecarTest() : input_(write("in", "data")), product_(write("out", "product")) {}

  Provenance provenance(double smoothing = 1) const {
    return make_provenance("fit", {{"fit.smoothing", {{"value", smoothing}, {"unit", "-"}}}},
                           {input_}, product_);
  }
  void write_sidecar(Status status) const {
    const Outcome outcome{status, {"because"}, {{"rms_mm", 0.25}}};
    write_text_atomically(sidecar_path(product_),
                          make_sidecar(product_, provenance(), outcome, {"out"}, {}).dump());
  }

  std::filesystem::path input_, product_;
};

TEST_F(SidecarTest, AProductIsCurrentWhileNothingChanged) {
  write_sidecar(Status::ok);
  EXPECT_TRUE(current_sidecar(product_, provenance()));
}

TEST_F(SidecarTest, AProductIsNotCurrentAfterAnyChange) {
  EXPECT_FALSE(current_sidecar(product_, provenance())) << "no sidecar";
  write_sidecar(Status::ok);
  EXPECT_FALSE(current_sidecar(product_, provenance(2))) << "another parameter";
  write("out", "damaged");
  EXPECT_FALSE(current_sidecar(product_, provenance())) << "another product";
  write("out", "product");
  EXPECT_TRUE(current_sidecar(product_, provenance()));
  write("in", "other data");
  EXPECT_FALSE(current_sidecar(product_, provenance())) << "another input";
}

TEST_F(SidecarTest, TextThatIsNoUtf8DoesNotEndAStage) {
  nlohmann::json sidecar{{"reasons", {"a series called M\xfcller"}}};
  mammotwin::write_sidecar(product_, sidecar);
  EXPECT_NE(text_of(sidecar_path(product_)).find("M\xef\xbf\xbdller"), std::string::npos);
}

TEST_F(SidecarTest, APipeAsAnInputIsRefusedAndNotWaitedFor) {
  ASSERT_EQ(mkfifo((folder_ / "pipe").c_str(), 0600), 0);
  const std::string message = message_of([&] { sha256_of_path(folder_ / "pipe"); });
  EXPECT_NE(message.find("pipe: cannot be read; expected a file"), std::string::npos) << message;
}

TEST_F(SidecarTest, FormerOutputsDoNotLeadOutOfTheFolder) {
  EXPECT_TRUE(former_outputs(product_).empty());
  write("out.json", R"({"outputs": [{"path": "out"}, {"path": "dicom/cc.dcm"}, {"path": "../in"},
                                    {"path": "a/../../in"}, {"path": "/in"}]})");
  EXPECT_EQ(former_outputs(product_), (std::vector<std::string>{"out", "dicom/cc.dcm"}));
}

TEST_F(SidecarTest, AFailedStageIsNeverCurrent) {
  write_sidecar(Status::not_converged);
  EXPECT_FALSE(current_sidecar(product_, provenance()));
}

TEST_F(SidecarTest, PathsAreRelative) {
  const auto p = provenance();
  EXPECT_EQ(p.inputs[0]["path"], "in");
}

TEST_F(SidecarTest, ReasonsNameFilesByTheirFolderAndName) {
  const auto reason = [&](const std::string& text) {
    const Outcome outcome{Status::refused, {text}, nlohmann::json::object()};
    return make_sidecar(product_, provenance(), outcome, {}, {})["reasons"][0].get<std::string>();
  };
  EXPECT_EQ(reason("/home/anna/patients/042/patient.toml: side is 3"),
            "042/patient.toml: side is 3");
  EXPECT_EQ(reason("the file \"/a/b/c.nrrd\" ends early"), "the file \"b/c.nrrd\" ends early");
  EXPECT_EQ(reason("12 N/mm, CC/MLO and 042/x.nrrd stay"), "12 N/mm, CC/MLO and 042/x.nrrd stay");
}

TEST_F(SidecarTest, PathsAreTheSameBeforeTheResultsFolderExists) {
  const auto here = std::filesystem::current_path();
  std::filesystem::current_path(folder_);
  const auto p = make_provenance("fit", {}, {"in"}, "results/042/out");
  std::filesystem::current_path(here);
  EXPECT_EQ(p.inputs[0]["path"], "../../in");
}

TEST_F(SidecarTest, AFoldersChecksumSeesNamesAndBytes) {
  std::filesystem::create_directory(folder_ / "mri");
  write("mri/a", "1");
  const std::string before = sha256_of_path(folder_ / "mri");
  std::filesystem::rename(folder_ / "mri/a", folder_ / "mri/b");
  EXPECT_NE(sha256_of_path(folder_ / "mri"), before);
  std::filesystem::rename(folder_ / "mri/b", folder_ / "mri/a");
  EXPECT_EQ(sha256_of_path(folder_ / "mri"), before);
  write("mri/a", "2");
  EXPECT_NE(sha256_of_path(folder_ / "mri"), before);
}

TEST(Status, HasTheExitCodesOfTheHouse) {
  EXPECT_EQ(exit_code(Status::ok), 0);
  EXPECT_EQ(exit_code(Status::look), 0);
  EXPECT_EQ(exit_code(Status::refused), 1);
  EXPECT_EQ(exit_code(Status::not_converged), 3);
}

}  // namespace
}  // namespace mammotwin
