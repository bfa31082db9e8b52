#include "segmentation/files/check_meta_header.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "segmentation/files/detached_data.h"
#include "segmentation/files/unpacked_size.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
constexpr int longest_line = 250, most_lines = 200;
constexpr int most_dimensions = 10;  // MetaIO's arrays
constexpr char data_file_field[] = "ElementDataFile";

[[noreturn]] void fail_meta(const std::string& found) {
  throw std::runtime_error("its header cannot be read: " + found +
                           "; expected lines \"Name = value\" up to ElementDataFile (is the file "
                           "damaged, or no MetaImage?)");
}

/// The next line; throws where it is longer than a header's.
std::string next_meta_line(std::ifstream& file) {
  std::array<char, longest_line + 2> buffer{};
  file.getline(buffer.data(), buffer.size());
  if (file.eof() && buffer[0] == '\0') fail_meta("it ends before ElementDataFile");
  if (file.fail()) fail_meta("a line is longer than 250 characters");
  return buffer.data();
}

std::string trimmed(const std::string& text) {
  const std::size_t first = text.find_first_not_of(" \t\r");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") + 1 - first);
}

std::pair<std::string, std::string> field_of(const std::string& line) {
  const auto printable = [](unsigned char c) { return std::isprint(c) || c == '\t' || c == '\r'; };
  if (!std::all_of(line.begin(), line.end(), printable))
    fail_meta("a line holds characters that are no text");
  const std::size_t equals = line.find('=');
  if (equals == std::string::npos) fail_meta("a line has no \"=\"");
  return {trimmed(line.substr(0, equals)), trimmed(line.substr(equals + 1))};
}

/// A whole number from 1 to `most`.
int count_of(const std::string& text, const std::string& name, int most) {
  int count = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
  if (error != std::errc() || end != text.data() + text.size() || count < 1 || count > most)
    fail_meta(name + " is \"" + text + "\" where a whole number from 1 to " + std::to_string(most) +
              " belongs");
  return count;
}

void check_dimensions(const MetaHeader& header) {
  constexpr int most_voxels_an_axis = 100000;
  const int dimensions = count_of(header.field("NDims"), "NDims", most_dimensions);
  std::istringstream sizes(header.field("DimSize"));
  int found = 0;
  for (std::string size; sizes >> size; ++found) count_of(size, "DimSize", most_voxels_an_axis);
  if (found != dimensions)
    fail_meta("DimSize has " + std::to_string(found) + " numbers where NDims says " +
              std::to_string(dimensions));
}

bool is_true(std::string value) {
  for (char& c : value) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return value == "true" || value == "t" || value == "1";
}

}  // namespace

std::string MetaHeader::field(const std::string& name) const {
  const auto found = fields.find(name);
  return found == fields.end() ? std::string() : found->second;
}

MetaHeader read_meta_header(const fs::path& path) {
  std::ifstream file(path, std::ios::binary);
  MetaHeader header;
  for (int n = 0; n < most_lines; ++n) {
    const auto [name, value] = field_of(next_meta_line(file));
    header.fields[name] = value;
    if (name != data_file_field) continue;
    header.bytes = file.eof() ? fs::file_size(path) : static_cast<std::uintmax_t>(file.tellg());
    check_dimensions(header);
    return header;
  }
  fail_meta("ElementDataFile is not among its first 200 lines");
}

void check_meta_voxels(const fs::path& path, const MetaHeader& header, std::uintmax_t expected) {
  const auto detached = detached_data_file(path);
  const fs::path& file = detached ? *detached : path;
  const std::uintmax_t size = fs::file_size(file);
  std::uintmax_t skipped = header.bytes;
  if (detached) {
    const std::string given = header.field("HeaderSize");
    skipped = given.empty() || given.front() == '-' ? 0 : std::strtoull(given.c_str(), nullptr, 10);
  }
  const std::uintmax_t packed = size > skipped ? size - skipped : 0;
  const std::uintmax_t found =
      is_true(header.field("CompressedData")) ? unpacked_size(file, skipped, expected) : packed;
  if (found < expected)
    throw std::runtime_error("is truncated: " + std::to_string(found) +
                             " bytes of voxels; expected " + std::to_string(expected) +
                             " (copy or export it again)");
}

}  // namespace mammotwin
