#include "segmentation/files/scan_meta.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <stdexcept>
#include <string>

namespace mammotwin {
namespace {

constexpr int longest_line = 250, most_lines = 200;

[[noreturn]] void fail(const std::string& found) {
  throw std::runtime_error("its header cannot be read: " + found +
                           "; expected lines \"Name = value\" up to ElementDataFile (is the file "
                           "damaged, or no MetaImage?)");
}

/// The next line; throws where it is longer than a header's.
std::string next_line(std::ifstream& file) {
  std::array<char, longest_line + 2> buffer{};
  file.getline(buffer.data(), buffer.size());
  if (file.eof() && buffer[0] == '\0') fail("it ends before ElementDataFile");
  if (file.fail()) fail("a line is longer than 250 characters");
  return buffer.data();
}

void check_line(const std::string& line) {
  const auto printable = [](unsigned char c) { return std::isprint(c) || c == '\t' || c == '\r'; };
  if (!std::all_of(line.begin(), line.end(), printable))
    fail("a line holds characters that are no text");
  if (line.find('=') == std::string::npos) fail("a line has no \"=\"");
}

}  // namespace

void check_meta_header(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  for (int n = 0; n < most_lines; ++n) {
    const std::string line = next_line(file);
    check_line(line);
    if (line.rfind("ElementDataFile", 0) == 0 && line.find_first_of(" =\t") == 15) return;
  }
  fail("ElementDataFile is not among its first 200 lines");
}

}  // namespace mammotwin
