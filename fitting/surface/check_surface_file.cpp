#include "fitting/surface/check_surface_file.h"

#include <cctype>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <set>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace mammotwin {
namespace {

class SurfaceHeader {
 public:
  explicit SurfaceHeader(const std::filesystem::path& path)
      : path_(path),
        in_(path, std::ios::binary),
        bytes_(static_cast<double>(std::filesystem::file_size(path))) {
    std::getline(in_, line_);
  }

  /// As CGAL does, by the name's ending.
  void check() {
    std::string ending = path_.extension().string();
    for (char& c : ending) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    if (ending == ".off") check_off();
    if (ending == ".ply") check_ply();
  }

 private:
  void check_ply() {
    if (!line_.starts_with("ply")) refuse("does not begin with ply");
    bool element = false;
    while (std::getline(in_, line_)) {
      std::istringstream words(line_);
      std::string first, name, count;
      words >> first >> name >> count;
      if (first == "end_header") return;
      if (first == "element") {
        element = true;
        count_of(name, count);
      } else if (first.starts_with("prop") && !element) {
        refuse("its header has a property of no element");
      }
    }
    refuse("its header has no end");
  }

  /// Vertices, faces and edges are counted behind OFF or in the next line; then each vertex and
  /// each face has a line of its own, a face with the number of its vertices before them.
  void check_off() {
    static const std::set<std::string> of_points_in_space{"OFF",   "COFF",   "NOFF",   "CNOFF",
                                                          "STOFF", "STCOFF", "STNOFF", "STCNOFF"};
    std::vector<std::string> counts = words_of(line_);
    if (counts.empty()) counts = next_line();  // comments may come before
    if (counts.empty() || !of_points_in_space.contains(counts[0]))
      refuse("does not begin with OFF", "an OFF file of points in space, or PLY, STL or OBJ");
    counts.erase(counts.begin());
    if (counts.empty()) counts = next_line();
    if (!counts.empty() && counts[0] == "BINARY")
      refuse("is a binary OFF file", "one in text, or PLY, STL or OBJ");
    if (counts.size() < 2) refuse("its header has no counts");
    const double vertices = count_of("vertex", counts[0]), faces = count_of("face", counts[1]);
    for (double n = 0; n < vertices; ++n)
      if (next_line().size() < 3) refuse("a vertex has no line of three numbers");
    for (double n = 0; n < faces; ++n) {
      const std::vector<std::string> face = next_line();
      if (face.empty()) refuse("has fewer faces than its header says");
      if (count_of("vertices of a face and fewer", face[0]) > static_cast<double>(face.size()) - 1)
        refuse("a face has no line that holds its vertices");
    }
  }

  /// The words of the next line that has any, comments left out; none at the file's end.
  std::vector<std::string> next_line() {
    while (std::getline(in_, line_))
      if (auto words = words_of(line_); !words.empty()) return words;
    return {};
  }

  static std::vector<std::string> words_of(const std::string& line) {
    std::istringstream in(line.substr(0, line.find('#')));
    return {std::istream_iterator<std::string>(in), {}};
  }

  double count_of(const std::string& name, const std::string& text) const {
    char* end = nullptr;
    const double count = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !(count >= 0) || count > bytes_)
      refuse("its header says \"" + text + "\" " + name + " entries, in " +
             std::to_string(static_cast<long long>(bytes_)) + " bytes");
    return count;
  }

  [[noreturn]] void refuse(const std::string& what, const std::string& expected =
                                                        "a whole PLY, STL, OBJ or OFF file") const {
    throw std::runtime_error(path_.string() + ": " + what + "; expected " + expected +
                             " (export it again)");
  }

  const std::filesystem::path& path_;
  std::ifstream in_;
  double bytes_;
  std::string line_;
};

}  // namespace

void check_surface_file(const std::filesystem::path& path) {
  if (std::filesystem::is_regular_file(path)) SurfaceHeader(path).check();
}

}  // namespace mammotwin
