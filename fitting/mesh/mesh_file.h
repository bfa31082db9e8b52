#pragma once

#include <array>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "fitting/mesh/hermite_mesh.h"

namespace mammotwin {

enum class FaceLabel : int { interior = 0, skin = 1, chest_wall = 2, cut = 3 };

/// Labels of an element's faces in the order ξ₁ = 0, ξ₁ = 1, ξ₂ = 0, ξ₂ = 1, ξ₃ = 0, ξ₃ = 1.
using FaceLabels = std::array<FaceLabel, 6>;

/// Parameter `parameter` of `node` equals `factor` times parameter `to_parameter` of `to_node`,
/// in every component: how nodes that stand at one place stay together.
struct ParameterTie {
  int node, parameter, to_node, to_parameter;
  double factor;
};

/// Values at the control points of BezierMesh(mesh), which VTK blends as it does positions.
struct PointField {
  int components = 1;
  std::vector<double> values;  ///< components x points, a point's components together
};

/// Everything that a mesh file holds. `mesh` is the configuration that the file shows.
struct MeshFile {
  HermiteMesh mesh;
  std::vector<FaceLabels> faces;   ///< one entry an element, or empty: all interior
  std::vector<ParameterTie> ties;  ///< empty where no two nodes stand at one place
  /// Nodal parameters [mm] of the same elements in other configurations, by name ("prone");
  /// viewers see the displacement from each as point data `displacement_from_<name>`.
  std::map<std::string, std::vector<HermiteMesh::Node>> configurations;
  std::map<std::string, std::vector<double>> metadata;
  std::map<std::string, PointField> fields;
};

/// Field that takes the values of `value` at ξ = 0, 1/3, 2/3, 1 along each direction; for
/// functions that are continuous over the mesh.
PointField interpolate_field(const HermiteMesh& mesh,
                             const std::function<double(const MeshPoint&)>& value);

/// Reads what write_mesh_file wrote; every double comes back bit for bit.
/// Throws std::runtime_error naming the file, the array and what is wrong with it.
MeshFile read_mesh_file(const std::filesystem::path& path);

/// Writes VTK's XML unstructured grid, version 2.2: cells of type VTK_BEZIER_HEXAHEDRON, and
/// the Hermite parameters as field data (format: fitting/mesh/README.md).
/// Throws std::invalid_argument if sizes do not match or a number is not finite,
/// std::runtime_error if the file cannot be written.
void write_mesh_file(const std::filesystem::path& path, const MeshFile& file);

/// Writes EX version 2, the text format of OpenCMISS-Zinc, with unit scale factors; nodes and
/// elements are numbered from 1 there. Throws std::runtime_error if the file cannot be written.
void write_exf(const std::filesystem::path& path, const HermiteMesh& mesh);

}  // namespace mammotwin
