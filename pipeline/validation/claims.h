#pragma once

#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "pipeline/validation/gel_cylinder/gel_cylinder.h"

namespace mammotwin {

/// One line of a comparison of elements or penalties.
struct ClaimRow {
  std::string name;
  CylinderFigures figures;
  double strain_jump = 0;  ///< strain_jump.h
  double penalty = 0;      ///< x shear modulus / element size
  bool continued = true;   ///< the penalty raised inside the load step
};

using Say = std::function<void(const std::string&)>;

/// Paper, 3.2: tri-cubic Hermite elements beside trilinear and triquadratic ones, on the lateral
/// cylinder with meshes from coarse to fine.
std::vector<ClaimRow> compare_elements(const CylinderExperiment& lateral, const Say& say);

/// Paper, 2.3: the penalty over five decades, raised inside the load step and given as it is.
std::vector<ClaimRow> compare_penalties(const CylinderExperiment& lateral, const Say& say);

/// `force_N`: what other codes found.
std::string element_table(const std::vector<ClaimRow>& rows, double force_N);
std::string penalty_table(const std::vector<ClaimRow>& rows, double force_N);
nlohmann::json to_json(const std::vector<ClaimRow>& rows, double force_N);

}  // namespace mammotwin
