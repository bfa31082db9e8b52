#include "fitting/mesh/mesh_file.h"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkHigherOrderHexahedron.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkUnstructuredGrid.h>

#include <cmath>
#include <stdexcept>

#include "fitting/mesh/bezier.h"
#include "fitting/mesh/vtu_arrays.h"

namespace mammotwin {

namespace {

constexpr const char* nodes_name = "hermite_nodes";
constexpr const char* elements_name = "hermite_elements";
constexpr const char* faces_name = "face_labels";
constexpr const char* ties_name = "parameter_ties";
const std::string configuration_prefix = "configuration:";
const std::string metadata_prefix = "metadata:";
const std::string displacement_prefix = "displacement_from_";

// ---- writing ----

void require(bool condition, const std::string& message) {
  if (!condition) throw std::invalid_argument("write_mesh_file: " + message);
}

void check(const MeshFile& file) {
  const auto finite = [](const std::vector<HermiteMesh::Node>& nodes) {
    for (const auto& node : nodes)
      if (!node.allFinite()) return false;
    return true;
  };
  require(finite(file.mesh.nodes()), "a nodal parameter is not finite");
  require(file.faces.empty() || static_cast<int>(file.faces.size()) == file.mesh.num_elements(),
          "faces needs one entry an element");
  for (const auto& [name, nodes] : file.configurations) {
    require(static_cast<int>(nodes.size()) == file.mesh.num_nodes(),
            "configuration " + name + " needs one entry a node");
    require(finite(nodes), "configuration " + name + " has a parameter that is not finite");
  }
}

std::vector<double> flat(const std::vector<HermiteMesh::Node>& nodes) {
  std::vector<double> values;
  for (const auto& node : nodes)
    values.insert(values.end(), node.data(), node.data() + node.size());
  return values;
}

std::vector<int> flat(const std::vector<HermiteMesh::Corners>& elements) {
  std::vector<int> values;
  for (const auto& corners : elements) values.insert(values.end(), corners.begin(), corners.end());
  return values;
}

void add_cells(vtkUnstructuredGrid* grid, const BezierMesh& bezier) {
  constexpr std::array<int, 3> cubic = {3, 3, 3};
  for (const auto& element : bezier.elements) {
    std::array<vtkIdType, 64> ids;
    for (int m = 0; m < 64; ++m)
      ids[vtkHigherOrderHexahedron::PointIndexFromIJK(m % 4, m / 4 % 4, m / 16, cubic.data())] =
          element[m];
    grid->InsertNextCell(VTK_BEZIER_HEXAHEDRON, 64, ids.data());
  }
}

void add_points(vtkUnstructuredGrid* grid, const MeshFile& file, const BezierMesh& bezier) {
  vtkNew<vtkPoints> points;
  points->SetDataTypeToDouble();
  for (const auto& p : bezier.points)
    points->InsertNextPoint(BezierMesh::value(file.mesh.node(p.node), p.sign).data());
  grid->SetPoints(points);
}

void add_point_data(vtkUnstructuredGrid* grid, const MeshFile& file, const BezierMesh& bezier) {
  for (const auto& [name, field] : file.fields) {
    require(field.values.size() == bezier.points.size() * field.components,
            "field " + name + " needs one value a control point");
    add_array(grid->GetPointData(), name, field.components, field.values);
  }
  for (const auto& [name, nodes] : file.configurations) {
    std::vector<double> values;
    for (const auto& p : bezier.points) {
      const HermiteMesh::Node difference = file.mesh.node(p.node) - nodes[p.node];
      const Eigen::Vector3d u = BezierMesh::value(difference, p.sign);
      values.insert(values.end(), u.data(), u.data() + 3);
    }
    add_array(grid->GetPointData(), displacement_prefix + name, 3, values);
  }
}

void add_face_labels(vtkUnstructuredGrid* grid, const MeshFile& file) {
  std::vector<int> labels;
  for (const auto& element : file.faces)
    for (FaceLabel label : element) labels.push_back(static_cast<int>(label));
  if (!labels.empty()) add_array(grid->GetCellData(), faces_name, 6, labels);
}

void add_field_data(vtkUnstructuredGrid* grid, const MeshFile& file) {
  vtkFieldData* data = grid->GetFieldData();
  add_array(data, nodes_name, 24, flat(file.mesh.nodes()));
  add_array(data, elements_name, 8, flat(file.mesh.elements()));
  for (const auto& [name, nodes] : file.configurations)
    add_array(data, configuration_prefix + name, 24, flat(nodes));
  for (const auto& [name, values] : file.metadata)
    add_array(data, metadata_prefix + name, 1, values);
  std::vector<double> ties;
  for (const auto& t : file.ties)
    ties.insert(ties.end(), {double(t.node), double(t.parameter), double(t.to_node),
                             double(t.to_parameter), t.factor});
  if (!ties.empty()) add_array(data, ties_name, 5, ties);
}

// ---- reading ----

/// `value` as an index below `limit`; -1 where it is none.
int index_below(double value, int limit) {
  return value >= 0 && value < limit && value == std::floor(value) ? static_cast<int>(value) : -1;
}

std::vector<HermiteMesh::Node> nodes_from(const ArrayReader& in, const std::string& name) {
  const std::vector<double> values = in.doubles(name, 24);
  std::vector<HermiteMesh::Node> nodes;
  for (std::size_t i = 0; i < values.size(); i += 24) {
    nodes.push_back(Eigen::Map<const HermiteMesh::Node>(&values[i]));
    if (!nodes.back().allFinite())
      in.fail(name, "holds a number that is not finite at node " + std::to_string(i / 24));
  }
  return nodes;
}

std::vector<HermiteMesh::Corners> elements_from(const ArrayReader& in, int num_nodes) {
  const std::vector<double> values = in.doubles(elements_name, 8);
  std::vector<HermiteMesh::Corners> elements(values.size() / 8);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const int node = index_below(values[i], num_nodes);
    if (node < 0)
      in.fail(elements_name, "names node " + std::to_string(values[i]) + " in element " +
                                 std::to_string(i / 8) + "; the file has " +
                                 std::to_string(num_nodes) + " nodes");
    elements[i / 8][i % 8] = node;
  }
  return elements;
}

std::vector<FaceLabels> faces_from(const ArrayReader& in) {
  std::vector<FaceLabels> faces;
  if (!in.has(faces_name)) return faces;
  const std::vector<double> values = in.doubles(faces_name, 6);
  faces.resize(values.size() / 6);
  for (std::size_t i = 0; i < values.size(); ++i) {
    const int label = index_below(values[i], static_cast<int>(FaceLabel::cut) + 1);
    if (label < 0) in.fail(faces_name, "holds " + std::to_string(values[i]) + "; expected 0 to 3");
    faces[i / 6][i % 6] = static_cast<FaceLabel>(label);
  }
  return faces;
}

std::vector<ParameterTie> ties_from(const ArrayReader& in, int num_nodes) {
  std::vector<ParameterTie> ties;
  if (!in.has(ties_name)) return ties;
  const std::vector<double> v = in.doubles(ties_name, 5);
  for (std::size_t i = 0; i < v.size(); i += 5) {
    const ParameterTie tie{index_below(v[i], num_nodes), index_below(v[i + 1], 8),
                           index_below(v[i + 2], num_nodes), index_below(v[i + 3], 8), v[i + 4]};
    if (tie.node < 0 || tie.parameter < 0 || tie.to_node < 0 || tie.to_parameter < 0)
      in.fail(ties_name,
              "names a node or parameter that does not exist in row " + std::to_string(i / 5));
    if (!std::isfinite(tie.factor))
      in.fail(ties_name, "has a factor that is not finite in row " + std::to_string(i / 5));
    ties.push_back(tie);
  }
  return ties;
}

std::vector<double> finite_numbers(const ArrayReader& in, const std::string& name) {
  const std::vector<double> values = in.doubles(name, 1);
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      in.fail(name, "holds a number that is not finite in row " + std::to_string(i));
  return values;
}

/// `num_points`: control points of the mesh.
PointField point_field_from(const ArrayReader& in, vtkDataArray* array, std::size_t num_points) {
  if (static_cast<std::size_t>(array->GetNumberOfTuples()) != num_points)
    in.fail(array->GetName(), "has " + std::to_string(array->GetNumberOfTuples()) +
                                  " rows; expected " + std::to_string(num_points) +
                                  " control points");
  PointField field;
  field.components = array->GetNumberOfComponents();
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    for (int c = 0; c < field.components; ++c) field.values.push_back(array->GetComponent(i, c));
  return field;
}

std::map<std::string, PointField> fields_from(const std::filesystem::path& path,
                                              vtkPointData* point_data, std::size_t num_points) {
  const ArrayReader in(path, point_data);
  std::map<std::string, PointField> fields;
  for (int i = 0; i < point_data->GetNumberOfArrays(); ++i) {
    vtkDataArray* array = point_data->GetArray(i);
    if (array && array->GetName() &&
        !std::string(array->GetName()).starts_with(displacement_prefix))
      fields[array->GetName()] = point_field_from(in, array, num_points);
  }
  return fields;
}

}  // namespace

PointField interpolate_field(const HermiteMesh& mesh,
                             const std::function<double(const MeshPoint&)>& value) {
  const BezierMesh bezier(mesh);
  PointField field{1, std::vector<double>(bezier.points.size())};
  for (int e = 0; e < mesh.num_elements(); ++e) {
    std::array<double, 64> samples;
    for (int m = 0; m < 64; ++m)
      samples[m] = value({e, Eigen::Vector3d(m % 4, m / 4 % 4, m / 16) / 3});
    const auto control = bezier_from_samples(samples);
    for (int m = 0; m < 64; ++m) field.values[bezier.elements[e][m]] = control[m];
  }
  return field;
}

void write_mesh_file(const std::filesystem::path& path, const MeshFile& file) {
  check(file);
  const BezierMesh bezier(file.mesh);
  vtkNew<vtkUnstructuredGrid> grid;
  add_points(grid, file, bezier);
  add_cells(grid, bezier);
  add_point_data(grid, file, bezier);
  add_face_labels(grid, file);
  add_field_data(grid, file);
  write_grid(path, grid);
}

MeshFile read_mesh_file(const std::filesystem::path& path) {
  const auto grid = read_grid(path);
  const ArrayReader field_data(path, grid->GetFieldData());
  const ArrayReader cell_data(path, grid->GetCellData());
  auto nodes = nodes_from(field_data, nodes_name);
  const int num_nodes = static_cast<int>(nodes.size());
  auto elements = elements_from(field_data, num_nodes);
  MeshFile file{HermiteMesh(std::move(nodes), std::move(elements)),
                faces_from(cell_data),
                ties_from(field_data, num_nodes),
                {},
                {},
                {}};
  if (file.mesh.num_elements() == 0) field_data.fail(elements_name, "is empty; expected elements");
  if (!file.faces.empty() && static_cast<int>(file.faces.size()) != file.mesh.num_elements())
    cell_data.fail(faces_name, "has " + std::to_string(file.faces.size()) + " rows; expected " +
                                   std::to_string(file.mesh.num_elements()) + " elements");
  for (const auto& name : field_data.names_with_prefix(configuration_prefix)) {
    auto& configuration = file.configurations[name];
    configuration = nodes_from(field_data, configuration_prefix + name);
    if (static_cast<int>(configuration.size()) != num_nodes)
      field_data.fail(configuration_prefix + name, "has " + std::to_string(configuration.size()) +
                                                       " rows; expected " +
                                                       std::to_string(num_nodes) + " nodes");
  }
  for (const auto& name : field_data.names_with_prefix(metadata_prefix))
    file.metadata[name] = finite_numbers(field_data, metadata_prefix + name);
  file.fields = fields_from(path, grid->GetPointData(), BezierMesh(file.mesh).points.size());
  return file;
}

}  // namespace mammotwin
