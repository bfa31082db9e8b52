#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <vector>

namespace mammotwin {

/// How far each of a number of points lies from where it was seen with stiffnesses times a factor
/// [mm]; empty where the breast does not come to rest.
using DistancesAtFactor = std::function<std::vector<double>(double factor)>;

struct FactorByCeres {
  std::optional<double> factor;  ///< empty where the breast does not come to rest at 1
  int trials = 0;                ///< calls of the function, those for differences included
};

/// The factor with the least sum of squared distances by Ceres, from 1 on, its derivative by
/// differences; `bounded`: between 0.1 and 10, as fit_stiffness searches it.
FactorByCeres factor_by_ceres(const DistancesAtFactor& distances, bool bounded);

/// A hanging block of fat that was made with known stiffness and is seen on its back, exactly, with
/// errors of 1 mm, and so heavy that with its stiffness as set it cannot come to rest: what
/// fit_stiffness finds and with how many unloadings, and what Ceres. `cases` of a table for
/// docs/measured.
nlohmann::json stiffness_fits();

}  // namespace mammotwin
