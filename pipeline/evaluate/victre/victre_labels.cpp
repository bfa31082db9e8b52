#include "pipeline/evaluate/victre/victre_labels.h"

#include <zlib.h>

#include <fstream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <string>

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector3d;
using Eigen::Vector3i;

enum Label : std::uint8_t {
  air = 0,
  gland = 29,
  nipple = 33,
  muscle = 40,
  plate = 50,
  lobule = 95,
  duct = 125
};

std::map<std::string, std::string> read_header(const fs::path& path) {
  std::ifstream in(path);
  if (!in) throw std::runtime_error(path.string() + ": no such file");
  std::map<std::string, std::string> header;
  for (std::string line; std::getline(in, line);)
    if (const auto equals = line.find(" = "); equals != std::string::npos)
      header[line.substr(0, equals)] = line.substr(equals + 3);
  return header;
}

template <class Number>
Eigen::Matrix<Number, 3, 1> three(const std::map<std::string, std::string>& header,
                                  const std::string& key) {
  std::istringstream in(header.at(key));
  Eigen::Matrix<Number, 3, 1> values;
  in >> values[0] >> values[1] >> values[2];
  return values;
}

std::vector<std::uint8_t> inflate_file(const fs::path& path, std::size_t size) {
  std::vector<std::uint8_t> bytes(size);
  const gzFile file = gzopen(path.c_str(), "rb");
  if (!file) throw std::runtime_error(path.string() + ": no such file");
  const int count = gzread(file, bytes.data(), static_cast<unsigned>(size));
  gzclose(file);
  if (count < 0 || static_cast<std::size_t>(count) != size)
    throw std::runtime_error(path.string() + ": is shorter than its header says");
  return bytes;
}

Vector3d turned(const Vector3d& file) { return {file.y(), file.z(), file.x()}; }

}  // namespace

namespace victre {
bool is_breast(std::uint8_t v) { return v != air && v != muscle && v != plate; }
bool is_gland(std::uint8_t v) { return v == gland || v == nipple || v == lobule || v == duct; }
}  // namespace victre

std::uint8_t VictreLabels::at(const Vector3d& x) const {
  const Vector3i i = values.index(x).array().round().cast<int>();
  return values.contains(i.x(), i.y(), i.z()) ? values(i.x(), i.y(), i.z()) : 0;
}

VictreLabels read_victre_labels(const fs::path& folder, const std::string& name) {
  const auto header = read_header(folder / (name + ".mhd"));
  const Vector3i size = three<int>(header, "DimSize");
  const auto bytes =
      inflate_file(folder / (name + ".raw.gz"), static_cast<std::size_t>(size.prod()));
  VictreLabels labels{Volume<std::uint8_t>({size.y(), size.z(), size.x()},
                                           turned(three<double>(header, "ElementSpacing")),
                                           turned(three<double>(header, "Offset")))};
  std::size_t next = 0;
  for (int z = 0; z < size.z(); ++z)
    for (int y = 0; y < size.y(); ++y)
      for (int x = 0; x < size.x(); ++x) labels.values(y, z, x) = bytes[next++];
  return labels;
}

}  // namespace mammotwin
