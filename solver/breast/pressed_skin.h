#pragma once

#include <Eigen/Core>
#include <functional>

namespace mammotwin {

/// Skin that something rigid pressed while the breast was imaged (a coil's plates). With what it
/// pressed no image shows; how far the skin would go outward without it can be guessed.
struct PressedSkin {
  struct Point {
    double share = 0;                                    ///< in [0, 1]: how much it is pressed skin
    Eigen::Vector3d outward = Eigen::Vector3d::UnitX();  ///< unit: off the breast
    double way = 0;                                      ///< in [0, 1], of `way_mm`
  };
  /// At a point of the imaged skin with its outward unit normal; empty: nothing pressed.
  std::function<Point(const Eigen::Vector3d& x, const Eigen::Vector3d& normal)> at;
  double way_mm = 0;  ///< from the imaged shape to the one free of load, where it is largest

  explicit operator bool() const { return static_cast<bool>(at); }
};

}  // namespace mammotwin
