#pragma once

#include <Eigen/Core>
#include <vector>

namespace mammotwin {

/// Distance to a line of points; `endless`: it goes on straight at both ends.
double distance_to_line(const Eigen::Vector2d& x, const std::vector<Eigen::Vector2d>& line,
                        bool endless);

/// Every fifth point of a curve and its last: its ends set the way in which it goes on, pieces of
/// some millimetres, not of a pixel.
std::vector<Eigen::Vector2d> coarse(const std::vector<Eigen::Vector2d>& curve);

}  // namespace mammotwin
