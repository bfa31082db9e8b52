#pragma once

#include <Eigen/Core>
#include <array>
#include <filesystem>
#include <vector>

namespace mammotwin {

/// A breast model of NiftySim: linear tetrahedra between moving plates, in the file's own frame
/// [mm, kg, s: kPa]. Here z runs from the chest wall to the nipple and the plates are normal to y.
struct NiftySimModel {
  struct ElementSet {
    std::vector<int> elements;
    double shear_modulus = 0, bulk_modulus = 0;  ///< [kPa]
  };
  struct Plate {
    Eigen::Vector3d corner, displacement;  ///< [mm]
  };
  std::vector<Eigen::Vector3d> nodes;
  std::vector<std::array<int, 4>> tetrahedra;
  std::vector<ElementSet> sets;
  std::vector<int> fixed_nodes;
  int fixed_component = 0;  ///< the one that is held at `fixed_nodes`: 0, 1, 2
  Eigen::Vector3d gravity = Eigen::Vector3d::Zero();  ///< [mm/s^2]
  double density = 0;                                 ///< [kg/mm^3]
  std::vector<Plate> plates;
};

/// Throws std::runtime_error naming file and entry where one is missing or not as expected (T4
/// elements, neo-Hookean sets of two parameters, one fixed component).
NiftySimModel read_niftysim_model(const std::filesystem::path& file);

/// Points of a legacy VTK file [mm], in its order.
std::vector<Eigen::Vector3d> read_vtk_points(const std::filesystem::path& file);

}  // namespace mammotwin
