#include "pipeline/frame/toml_file.h"

#include "tests/pipeline/scratch_folder.h"

namespace mammotwin {
namespace {

using TomlFileTest = ScratchFolder;

TEST_F(TomlFileTest, GivesDottedKeysAndListsOfTables) {
  const auto values = read_toml(write("patient.toml",
                                      "side = \"left\"\n"
                                      "[views.cc]\nthickness_mm = 55\n"
                                      "[[lesions]]\nid = \"L1\"\npoint_lps_mm = [1, 2.5, 3]\n"));
  std::map<std::string, nlohmann::json> by_key(values.begin(), values.end());
  EXPECT_EQ(by_key["side"], "left");
  EXPECT_EQ(by_key["views.cc.thickness_mm"], 55);
  EXPECT_EQ(by_key["lesions"][0]["point_lps_mm"][1], 2.5);
}

TEST_F(TomlFileTest, NamesFileLineAndColumnOfASyntaxError) {
  const auto file = write("patient.toml", "side = \"left\"\nmri = = 3\n");
  const std::string message = message_of([&] { read_toml(file); });
  EXPECT_NE(message.find("patient.toml: line 2"), std::string::npos) << message;
  EXPECT_EQ(message.find("http"), std::string::npos) << message;  // pages move
}

TEST_F(TomlFileTest, NamesAFileThatIsMissing) {
  const std::string message = message_of([&] { read_toml(folder_ / "none.toml"); });
  EXPECT_NE(message.find("none.toml: no such file"), std::string::npos) << message;
}

}  // namespace
}  // namespace mammotwin
