#pragma once

#include <array>
#include <map>
#include <string>
#include <vector>

namespace mammotwin {

using HeaderKeys = std::map<std::string, std::string>;  ///< of an image file, beside its geometry

/// An image in plain arrays: what passes to and from ITK, whose own copy of Eigen must not meet
/// the project's in one translation unit.
struct RawImage {
  std::array<int, 3> size{0, 0, 0};
  std::array<double, 3> spacing{1, 1, 1};                      ///< [mm]
  std::array<double, 3> origin{0, 0, 0};                       ///< LPS [mm]
  std::array<double, 9> direction{1, 0, 0, 0, 1, 0, 0, 0, 1};  ///< [3 r + a]: component r of axis a
  std::vector<float> values;                                   ///< first axis fastest
};

}  // namespace mammotwin
