#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

namespace mammotwin {

/// A figure of a population: the mean of the middle half of its values, and the standard deviation
/// of all of them.
struct PopulationFigure {
  double middle = 0, sd = 0;
  int women = 0;
};

/// Mean of the middle half of the values, whose ends count with what lies inside it; the slope of
/// that by each value is its weight.
struct MiddleHalf {
  double mean = 0;
  std::vector<double> weights;  ///< of each value, in their order; they sum to 1
};
/// Of at least one value.
MiddleHalf middle_half(const std::vector<double>& values);

/// What breasts of women imaged in both poses do from prone to supine [mm].
struct WomensMoves {
  PopulationFigure lateral, posterior;  ///< of nipples
  PopulationFigure landmark, ribs;  ///< of points inside, 10 to 60 mm from the ribs prone: their
                                    ///< way, and how far from the ribs they lie supine
};

/// prone_supine/points.csv of a folder of real cases (its README has the columns). Throws
/// std::runtime_error where it cannot be read or lacks a column.
WomensMoves read_womens_moves(const std::filesystem::path& points_csv);

/// A landmark inside a breast, from that breast's nipple: lateral, posterior, along the body [mm].
struct WomensLandmark {
  std::string woman;
  Eigen::Vector3d prone, supine;
};

/// Those of the same file whose breast has a nipple.
std::vector<WomensLandmark> read_womens_landmarks(const std::filesystem::path& points_csv);

}  // namespace mammotwin
