#include "segmentation/files/detached_data.h"

#include <cctype>
#include <fstream>
#include <stdexcept>
#include <string>

#include "segmentation/files/check_meta_header.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

std::string lower(std::string text) {
  for (char& c : text) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return text;
}

/// What a NRRD header says after "data file:"; empty where the voxels follow it.
std::string nrrd_data_file(const fs::path& path) {
  constexpr int most_lines = 1000;
  std::ifstream file(path, std::ios::binary);
  std::string line;
  for (int n = 0; n < most_lines && std::getline(file, line); ++n) {
    if (!line.empty() && line.back() == '\r') line.pop_back();
    if (line.empty()) break;
    for (const char* name : {"data file:", "datafile:"})
      if (lower(line).starts_with(name)) {
        const std::size_t value = line.find_first_not_of(' ', std::string(name).size());
        return value == std::string::npos ? std::string() : line.substr(value);
      }
  }
  return {};
}

std::string meta_data_file(const fs::path& path) {
  try {
    const std::string value = read_meta_header(path).field("ElementDataFile");
    return lower(value) == "local" ? std::string() : value;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
}

/// "LIST", or a pattern with numbers that is made into names.
bool names_several(const std::string& value) {
  return value.starts_with("LIST") || value.find('%') != std::string::npos;
}

}  // namespace

std::optional<fs::path> detached_data_file(const fs::path& path) {
  const std::string ending = lower(path.extension().string());
  const bool is_meta = ending == ".mhd" || ending == ".mha";
  const bool is_nrrd = ending == ".nhdr" || ending == ".nrrd";
  if ((!is_meta && !is_nrrd) || !fs::is_regular_file(path)) return std::nullopt;
  const std::string value = is_meta ? meta_data_file(path) : nrrd_data_file(path);
  if (value.empty()) return std::nullopt;
  if (names_several(value))
    throw std::runtime_error(path.string() +
                             ": spreads its voxels over several files; expected one (save the "
                             "image as .nrrd or .mha)");
  const fs::path data = path.parent_path() / value;
  if (!fs::is_regular_file(data))
    throw std::runtime_error(path.string() +
                             ": its voxels should lie in a file beside it that is not there; "
                             "expected header and data file together");
  return data;
}

}  // namespace mammotwin
