#pragma once

#include <cstdint>
#include <vector>

#include "segmentation/image/volume.h"

namespace mammotwin {

/// First row behind the breast in each column of a map; the number of rows where there is none.
struct WallFront {
  int columns = 0;
  std::vector<int> rows;  ///< i fastest
  int at(int i, int k) const { return rows[static_cast<std::size_t>(k) * columns + i]; }
  int& at(int i, int k) { return rows[static_cast<std::size_t>(k) * columns + i]; }
};

/// The front of the muscle in a map of Substance codes.
WallFront front_of_muscle(const Volume<std::uint8_t>& substance);

/// Fills what lies behind the front: muscle, 10 to 25 mm thick by `seed` and place, 8 mm of ribs
/// and what is between them, then lung with vessels, heart and liver.
void fill_thorax(const WallFront& front, std::uint64_t seed, Volume<std::uint8_t>& substance);

}  // namespace mammotwin
