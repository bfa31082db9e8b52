// The documentation against what it speaks of.

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <regex>
#include <string>

#include "tests/file_text.h"
#include "tests/where.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

const fs::path kSource = MAMMOTWIN_SOURCE_DIR;

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

std::vector<fs::path> pages() {
  std::vector<fs::path> found{kSource / "README.md", kSource / "CONTRIBUTING.md"};
  for (const char* folder :
       {"docs", "segmentation", "fitting", "solver", "registration", "pipeline", "sample_data"})
    for (const auto& entry : fs::recursive_directory_iterator(kSource / folder))
      if (entry.path().extension() == ".md") found.push_back(entry.path());
  return found;
}

TEST(Docs, LinkToFilesThatAreThere) {
  int links = 0;
  for (const fs::path& page : pages())
    for (const std::smatch& m : matches(text_of(page), std::regex("\\]\\(([^)#:]+)[^):]*\\)"))) {
      if (m.str(1) == "reference.md") continue;  // made from the programs
      EXPECT_TRUE(fs::exists(page.parent_path() / m.str(1))) << page << ": " << m.str(0);
      ++links;
    }
  EXPECT_GE(links, 60);
}

TEST(Docs, ReadmesAreOneScreen) {
  constexpr int screen = 60;  // lines
  for (const fs::path& page : pages()) {
    if (page.filename() != "README.md") continue;
    const std::string text = text_of(page);
    EXPECT_LE(std::count(text.begin(), text.end(), '\n'), screen) << page;
  }
}

// Keys that the pages tell a person to write are keys that the program knows.
TEST(Docs, NameKeysThatThereAre) {
  const std::string settings = text_of(kSource / "docs" / "settings.md");
  const std::string how_to = text_of(kSource / "docs" / "how_to.md");
  for (const char* key :
       {"register.search", "dicom_export", "materials.fat.c1_kpa", "materials.fat.law"}) {
    EXPECT_NE(how_to.find(key), std::string::npos) << key;
    EXPECT_NE(settings.find("| `" + std::string(key) + "` |"), std::string::npos) << key;
  }
}

}  // namespace
}  // namespace mammotwin
