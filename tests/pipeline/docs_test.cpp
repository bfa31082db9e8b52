// The documentation against what it speaks of.

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>

#include "tests/where.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = MAMMOTWIN_SOURCE_DIR;

std::string text_of(const fs::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::vector<std::smatch> matches(const std::string& text, const std::regex& pattern) {
  return {std::sregex_iterator(text.begin(), text.end(), pattern), {}};
}

TEST(Docs, NameFunctionsThatAreThere) {
  const std::string theory = text_of(kSource / "docs" / "theory.md");
  int named = 0;
  for (const std::smatch& m : matches(theory, std::regex("`([a-z_/]+\\.h)`: `([A-Za-z_]+)`"))) {
    const std::string header = text_of(kSource / m.str(1));
    EXPECT_FALSE(header.empty()) << m.str(1);
    EXPECT_TRUE(std::regex_search(header, std::regex("\\b" + m.str(2) + "\\b"))) << m.str(0);
    ++named;
  }
  EXPECT_GT(named, 30);
}

// The paper has equations 1 to 9.
TEST(Docs, FindAPlaceForEveryEquationOfThePaper) {
  const std::string theory = text_of(kSource / "docs" / "theory.md");
  for (int n = 1; n <= 9; ++n) {
    const std::string number = std::to_string(n);
    EXPECT_TRUE(std::regex_search(theory, std::regex("\\n\\| (\\d, )?" + number + "(, \\d)? \\|")))
        << number;
  }
}

TEST(Docs, LinkToPagesThatAreThere) {
  int links = 0;
  for (const auto& entry : fs::directory_iterator(kSource / "docs")) {
    if (entry.path().extension() != ".md") continue;
    const std::string text = text_of(entry.path());
    for (const std::smatch& m : matches(text, std::regex("\\]\\(([a-z_]+)\\.md\\)"))) {
      if (m.str(1) == "reference") continue;  // made from the programs
      EXPECT_TRUE(fs::exists(kSource / "docs" / (m.str(1) + ".md"))) << m.str(0);
      ++links;
    }
  }
  EXPECT_GE(links, 4);
}

// Keys that the pages tell a person to write are keys that the program knows.
TEST(Docs, NameKeysThatThereAre) {
  const std::string settings = text_of(kSource / "pipeline" / "README.md");
  const std::string how_to = text_of(kSource / "docs" / "how_to.md");
  for (const char* key :
       {"register.search", "dicom_export", "materials.fat.c1_kpa", "materials.fat.law"}) {
    EXPECT_NE(how_to.find(key), std::string::npos) << key;
    EXPECT_NE(settings.find("| `" + std::string(key) + "` |"), std::string::npos) << key;
  }
}

}  // namespace
}  // namespace mammotwin
