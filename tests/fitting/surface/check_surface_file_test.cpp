#include "fitting/surface/check_surface_file.h"

#include <gtest/gtest.h>

#include <fstream>

#include "fitting/surface/read_surface.h"
#include "tests/scratch_file.h"

namespace mammotwin {
namespace {

std::filesystem::path write_text(const std::string& name, const std::string& text) {
  const auto path = scratch_file(name);
  std::ofstream(path, std::ios::binary) << text;
  return path;
}

/// What is said of such a file; empty where it is let through.
std::string said_of(const std::string& name, const std::string& text) {
  try {
    check_surface_file(write_text(name, text));
  } catch (const std::runtime_error& error) {
    return error.what();
  }
  return "";
}

const std::string kTriangle = "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n";

TEST(CheckSurfaceFile, AnOffFileMayBeginWithComments) {
  for (const char* head : {"OFF ", "OFF\n", "# a breast\n\n# of a scanner\nOFF\n", "COFF # x\n"}) {
    const auto path = write_text("triangle.off", head + kTriangle);
    EXPECT_EQ(read_surface(path).triangles.size(), 1u) << head;
  }
}

TEST(CheckSurfaceFile, CountsBehindACommentAreBounded) {
  EXPECT_NE(said_of("a.off", "# c\nOFF\n3 2000000000 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n")
                .find("\"2000000000\" face entries"),
            std::string::npos);
  EXPECT_NE(said_of("a.OFF", "#\n#\nOFF 900000000 1 0\n").find("vertex entries"),
            std::string::npos);
}

TEST(CheckSurfaceFile, OtherKindsOfOffAreRefusedWithWhatIsTaken) {
  for (const char* head : {"OFF BINARY\n", "OFF\nBINARY\n", "# c\nOFF BINARY\n"}) {
    const std::string said = said_of("a.off", head + std::string("\0\0\0\3", 4));
    EXPECT_NE(said.find("is a binary OFF file; expected one in text, or PLY, STL or OBJ"),
              std::string::npos)
        << said;
  }
  for (const char* head : {"SKEL\n", "nOFF\n", "4OFF\n", "STCN4nOFF\n", ""})
    EXPECT_NE(said_of("a.off", head + kTriangle).find("does not begin with OFF"), std::string::npos)
        << head;
}

}  // namespace
}  // namespace mammotwin
