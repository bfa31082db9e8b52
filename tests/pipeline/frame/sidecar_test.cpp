#include "pipeline/frame/sidecar.h"

#include <sys/stat.h>

#include "pipeline/frame/checksum.h"
#include "pipeline/frame/products.h"
#include "pipeline/frame/sidecar_check.h"
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
                           {{"data", input_, true}}, product_);
  }
  void write_sidecar(Status status) const {
    const Outcome outcome{status, {"because"}, {{"rms_mm", 0.25}}};
    mammotwin::write_sidecar(product_, make_sidecar(product_, provenance(), outcome, {"out"}, {}));
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
  const nlohmann::json sidecar{{"reasons", {"a series called M\xfcller"}}};
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
  nlohmann::json sidecar =
      make_sidecar(product_, provenance(), {Status::ok, {}, nlohmann::json::object()}, {}, {});
  for (const char* path : {"out", "dicom/cc.dcm", "../in", "a/../../in", "/in"})
    sidecar["outputs"].push_back({{"path", path}, {"sha256", std::string(64, 'a')}});
  mammotwin::write_sidecar(product_, sidecar);
  EXPECT_EQ(former_outputs(product_), (std::vector<std::string>{"out", "dicom/cc.dcm"}));
}

TEST_F(SidecarTest, AnEditedOneIsNoticed) {
  write_sidecar(Status::ok);
  ASSERT_TRUE(read_sidecar(product_).sidecar);
  std::string text = text_of(sidecar_path(product_));
  const std::size_t figure = text.find("0.25");
  ASSERT_NE(figure, std::string::npos);
  write("out.json", text.replace(figure, 4, "0.15"));
  EXPECT_NE(read_sidecar(product_).fault.find("it was edited"), std::string::npos);
  EXPECT_FALSE(current_sidecar(product_, provenance()));
}

// A reading program would stop, or take what stands there for something else.
TEST_F(SidecarTest, AnyFieldThatIsMissingOrOfAnotherTypeIsNamed) {
  write_sidecar(Status::ok);
  const nlohmann::json whole = *read_sidecar(product_).sidecar;
  for (const auto& [name, value] : whole.items()) {
    for (const nlohmann::json& other :
         {nlohmann::json(), nlohmann::json(-1), nlohmann::json({{"path", 3}})}) {
      nlohmann::json damaged = whole;
      damaged[name] = other;
      if (name == "parameters" || name == "quality") damaged[name] = -1;
      write("out.json", sealed(damaged).dump());
      if (name == "sidecar_sha256") continue;  // sealed anew
      EXPECT_NE(read_sidecar(product_).fault.find(name + " is "), std::string::npos) << name;
    }
    nlohmann::json damaged = whole;
    damaged.erase(name);
    write("out.json", damaged.dump());
    EXPECT_NE(read_sidecar(product_).fault.find(name + " is missing"), std::string::npos) << name;
  }
}

TEST_F(SidecarTest, WhatIsNoSidecarAtAllIsSaidToBeNone) {
  EXPECT_TRUE(read_sidecar(product_).fault.empty()) << "none is there";
  for (const std::string& text : {std::string(), std::string("[1, 2"), std::string("[1, 2]"),
                                  std::string(200000, '['), std::string("{\"stage\": \"\xff\"}")}) {
    write("out.json", text);
    EXPECT_FALSE(read_sidecar(product_).fault.empty()) << text.substr(0, 9);
    EXPECT_FALSE(current_sidecar(product_, provenance()));
    EXPECT_TRUE(former_outputs(product_).empty());
  }
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
  const auto p = make_provenance("fit", {}, {{"data", "in", true}}, "results/042/out");
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
