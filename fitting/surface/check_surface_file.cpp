#include "fitting/surface/check_surface_file.h"

#include <cstdlib>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>

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

  void check() {
    if (line_.starts_with("ply")) check_ply();
    if (line_.find("OFF") != std::string::npos && line_.find("OFF") < 6) check_off();
  }

 private:
  void check_ply() {
    bool element = false;
    while (std::getline(in_, line_)) {
      std::istringstream words(line_);
      std::string first, name, count;
      words >> first >> name >> count;
      if (first == "end_header") return;
      if (first == "element") {
        element = true;
        check_count(name, count);
      } else if (first.starts_with("prop") && !element) {
        refuse("its header has a property of no element");
      }
    }
    refuse("its header has no end");
  }

  /// Vertices, faces and edges are the next three numbers that are no comment.
  void check_off() {
    if (line_.find("BINARY") != std::string::npos) refuse("is a binary OFF file");
    std::string counts = line_.substr(line_.find("OFF") + 3);
    for (std::string line; std::getline(in_, line);) {
      counts += ' ' + line.substr(0, line.find('#'));
      std::istringstream words(counts);
      std::string vertices, faces;
      if (!(words >> vertices >> faces)) continue;
      check_count("vertex", vertices);
      check_count("face", faces);
      return;
    }
    refuse("its header has no counts");
  }

  void check_count(const std::string& name, const std::string& text) const {
    char* end = nullptr;
    const double count = std::strtod(text.c_str(), &end);
    if (text.empty() || *end != '\0' || !(count >= 0) || count > bytes_)
      refuse("its header says \"" + text + "\" " + name + " entries, in " +
             std::to_string(static_cast<long long>(bytes_)) + " bytes");
  }

  [[noreturn]] void refuse(const std::string& what) const {
    throw std::runtime_error(path_.string() + ": " + what +
                             "; expected a whole PLY, STL, OBJ or OFF file (export it again)");
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
