#include "fitting/mesh/mesh_file.h"

#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLUnstructuredGridReader.h>

#include <fstream>
#include <limits>
#include <sstream>
#include <stdexcept>

#include "fitting/mesh/bezier_evaluation.h"
#include "fitting/mesh/cylinder_mesh.h"
#include "tests/fitting/distorted_mesh.h"

namespace mammotwin {
namespace {

using Eigen::Vector3d;

const std::vector<Vector3d> places_in_element = {{0, 0, 0},       {1, 1, 1},       {0.5, 0.5, 0.5},
                                                 {0.1, 0.7, 0.3}, {0.9, 0.2, 0.6}, {1, 0, 0.4}};

MeshFile full_example();

class MeshFileTest : public testing::Test {
 protected:
  void SetUp() override {
    folder_ = std::filesystem::temp_directory_path() /
              ("mammotwin_mesh_file_" +
               std::string(testing::UnitTest::GetInstance()->current_test_info()->name()));
    std::filesystem::create_directories(folder_);
  }
  void TearDown() override { std::filesystem::remove_all(folder_); }
  std::filesystem::path path(const std::string& name) const { return folder_ / name; }

  std::string written_example() const {
    write_mesh_file(path("a.vtu"), full_example());
    std::stringstream text;
    text << std::ifstream(path("a.vtu")).rdbuf();
    return text.str();
  }

  std::string error_of_reading(const std::filesystem::path& file) const {
    try {
      read_mesh_file(file);
    } catch (const std::runtime_error& error) {
      return error.what();
    }
    return "";
  }

 private:
  std::filesystem::path folder_;
};

MeshFile full_example() {
  MeshFile file{distorted_mesh({2, 1, 2}, 1.7), {}, {}, {}, {}, {}};
  file.faces.assign(4, FaceLabels{FaceLabel::cut, FaceLabel::interior, FaceLabel::cut,
                                  FaceLabel::cut, FaceLabel::chest_wall, FaceLabel::skin});
  file.ties = {{3, 1, 2, 4, -0.1}};
  file.configurations["prone"] = distorted_mesh({2, 1, 2}, 0.3).nodes();
  file.metadata["view_angle_deg"] = {45.0};
  file.metadata["view_axes"] = {0.1, 1.0 / 3, -2e-300};
  file.fields["distance_mm"] =
      interpolate_field(file.mesh, [&](const MeshPoint& p) { return file.mesh.position(p).x(); });
  return file;
}

TEST_F(MeshFileTest, AFileCutAnywhereIsRefused) {
  const std::string whole = written_example();
  for (double share : {0.1, 0.4, 0.7, 0.95}) {
    std::ofstream(path("b.vtu")) << whole.substr(0, static_cast<std::size_t>(share * whole.size()));
    const std::string error = error_of_reading(path("b.vtu"));
    EXPECT_NE(error.find("b.vtu: is not a whole .vtu file"), std::string::npos) << error;
  }
}

TEST_F(MeshFileTest, CountsThatTheFileCannotHoldAreRefused) {
  const std::string whole = written_example();
  for (const std::string count : {"99999999999999", "-1", "many"}) {
    const std::size_t begin = whole.find("NumberOfTuples=\"") + 16, end = whole.find('"', begin);
    std::ofstream(path("b.vtu")) << whole.substr(0, begin) << count << whole.substr(end);
    const std::string error = error_of_reading(path("b.vtu"));
    EXPECT_NE(error.find("NumberOfTuples is \"" + count + "\"; expected 0 to "), std::string::npos)
        << error;
  }
}

/// An array begins with 32-bit counts in base64: blocks, their length, the last one's, the packed
/// length of each.
TEST_F(MeshFileTest, AnArrayThatSaysToBeLongerThanTheFileIsRefused) {
  const std::string whole = written_example();
  const std::size_t tag = whole.find("format=\"binary\"");
  const std::size_t begin = whole.find_first_not_of(" \n", whole.find('>', tag) + 1);
  ASSERT_EQ(whole.substr(begin, 6), "AQAAAA");                                    // one block
  for (const auto& [at, digits] : {std::pair<int, std::string>{0, "/////w"},      // 2^32 - 1 blocks
                                   std::pair<int, std::string>{16, "/////w"}}) {  // packed
    std::string damaged = whole;
    damaged.replace(begin + at, digits.size(), digits);
    std::ofstream(path("b.vtu")) << damaged;
    const std::string error = error_of_reading(path("b.vtu"));
    EXPECT_NE(error.find("says to be longer than the file"), std::string::npos) << error;
  }
}

TEST_F(MeshFileTest, AnArrayThatIsThereTwiceIsRefused) {
  const std::string whole = written_example();
  for (const std::string name : {"face_labels", "metadata:view_angle_deg", "distance_mm"}) {
    const std::size_t begin = whole.rfind("<DataArray", whole.find("Name=\"" + name + "\""));
    const std::size_t end = whole.find("</DataArray>", begin) + std::string("</DataArray>").size();
    ASSERT_LT(begin, end);
    std::ofstream(path("b.vtu")) << whole.substr(0, end) << "\n"
                                 << whole.substr(begin, end - begin) << whole.substr(end);
    const std::string error = error_of_reading(path("b.vtu"));
    EXPECT_NE(error.find("b.vtu: array " + name + " is there twice"), std::string::npos) << error;
  }
}

TEST_F(MeshFileTest, EverythingComesBackBitForBit) {
  const MeshFile file = full_example();
  write_mesh_file(path("a.vtu"), file);
  const MeshFile back = read_mesh_file(path("a.vtu"));
  EXPECT_EQ(back.mesh.nodes(), file.mesh.nodes());
  EXPECT_EQ(back.mesh.elements(), file.mesh.elements());
  EXPECT_EQ(back.faces, file.faces);
  EXPECT_EQ(back.configurations, file.configurations);
  EXPECT_EQ(back.metadata, file.metadata);
  ASSERT_EQ(back.ties.size(), 1u);
  EXPECT_EQ(back.ties[0].to_parameter, 4);
  EXPECT_EQ(back.ties[0].factor, -0.1);
  ASSERT_EQ(back.fields.size(), 1u);
  EXPECT_EQ(back.fields.at("distance_mm").values, file.fields.at("distance_mm").values);
}

TEST_F(MeshFileTest, SeveralNodesAtOnePlaceComeBack) {
  const MeshFile file = cylinder_mesh(20, 50, {});
  write_mesh_file(path("cylinder.vtu"), file);
  const MeshFile back = read_mesh_file(path("cylinder.vtu"));
  EXPECT_EQ(back.mesh.nodes(), file.mesh.nodes());
  EXPECT_EQ(back.ties.size(), file.ties.size());
}

vtkSmartPointer<vtkUnstructuredGrid> as_vtk_reads(const std::filesystem::path& path) {
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  return reader->GetOutput();
}

TEST_F(MeshFileTest, VtkEvaluatesTheSamePositions) {
  const MeshFile file = full_example();
  write_mesh_file(path("a.vtu"), file);
  const auto grid = as_vtk_reads(path("a.vtu"));
  ASSERT_EQ(grid->GetNumberOfCells(), file.mesh.num_elements());
  for (int e = 0; e < file.mesh.num_elements(); ++e) {
    ASSERT_EQ(grid->GetCellType(e), VTK_BEZIER_HEXAHEDRON);
    for (const Vector3d& xi : places_in_element) {
      int sub = 0;
      double parametric[3] = {xi[0], xi[1], xi[2]};
      Vector3d x;
      double weights[64];
      grid->GetCell(e)->EvaluateLocation(sub, parametric, x.data(), weights);
      EXPECT_LT((x - file.mesh.position({e, xi})).norm(), 1e-12 * 40);  // 40 mm across
    }
  }
}

TEST_F(MeshFileTest, VtkSeesTheDisplacementAndTheFields) {
  const MeshFile file = full_example();
  const HermiteMesh prone(file.configurations.at("prone"), file.mesh.elements());
  write_mesh_file(path("a.vtu"), file);
  const auto grid = as_vtk_reads(path("a.vtu"));
  vtkDataArray* u = grid->GetPointData()->GetArray("displacement_from_prone");
  vtkDataArray* distance = grid->GetPointData()->GetArray("distance_mm");
  ASSERT_TRUE(u && distance);
  for (const Vector3d& xi : places_in_element) {
    double weights[64], parametric[3] = {xi[0], xi[1], xi[2]}, x[3];
    int sub = 0;
    vtkCell* cell = grid->GetCell(1);
    cell->EvaluateLocation(sub, parametric, x, weights);
    Vector3d blended = Vector3d::Zero();
    double blended_distance = 0;
    for (int i = 0; i < 64; ++i) {
      for (int a = 0; a < 3; ++a)
        blended[a] += weights[i] * u->GetComponent(cell->GetPointId(i), a);
      blended_distance += weights[i] * distance->GetComponent(cell->GetPointId(i), 0);
    }
    const MeshPoint p{1, xi};
    EXPECT_LT((blended - (file.mesh.position(p) - prone.position(p))).norm(), 1e-12 * 40);
    // The field is x itself, which is tri-cubic, so that the blend is exact.
    EXPECT_NEAR(blended_distance, file.mesh.position(p).x(), 1e-11);
  }
}

TEST_F(MeshFileTest, NeighboursShareTheirControlPoints) {
  const BezierMesh bezier(block_mesh(Vector3d::Zero(), Vector3d::Ones(), {2, 1, 1}));
  EXPECT_EQ(bezier.points.size(), 7u * 4 * 4);
}

TEST_F(MeshFileTest, DeclaresAVersionThatVtkReadsRightly) {
  write_mesh_file(path("a.vtu"), full_example());
  std::ifstream in(path("a.vtu"));
  std::stringstream text;
  text << in.rdbuf();
  EXPECT_NE(text.str().find("version=\"2.2\""), std::string::npos);
}

TEST_F(MeshFileTest, ATruncatedFileIsNamed) {
  write_mesh_file(path("a.vtu"), full_example());
  const auto size = std::filesystem::file_size(path("a.vtu"));
  for (double part : {0.0, 0.1, 0.5, 0.9, 0.99}) {
    std::filesystem::copy_file(path("a.vtu"), path("cut.vtu"),
                               std::filesystem::copy_options::overwrite_existing);
    std::filesystem::resize_file(path("cut.vtu"), static_cast<std::uintmax_t>(part * size));
    EXPECT_NE(error_of_reading(path("cut.vtu")).find("cut.vtu"), std::string::npos) << part;
  }
}

TEST_F(MeshFileTest, AMissingFileIsNamed) {
  EXPECT_NE(error_of_reading(path("none.vtu")).find("none.vtu: no such file"), std::string::npos);
}

/// A grid without cells that holds this field data, written by hand.
std::string grid_with(const std::string& field_data) {
  return "<VTKFile type=\"UnstructuredGrid\" version=\"2.2\" byte_order=\"LittleEndian\">"
         "<UnstructuredGrid><FieldData>" +
         field_data +
         "</FieldData><Piece NumberOfPoints=\"0\" NumberOfCells=\"0\"><Points>"
         "<DataArray type=\"Float64\" Name=\"Points\" NumberOfComponents=\"3\" format=\"ascii\"/>"
         "</Points><Cells>"
         "<DataArray type=\"Int64\" Name=\"connectivity\" format=\"ascii\"/>"
         "<DataArray type=\"Int64\" Name=\"offsets\" format=\"ascii\"/>"
         "<DataArray type=\"UInt8\" Name=\"types\" format=\"ascii\"/>"
         "</Cells></Piece></UnstructuredGrid></VTKFile>";
}

TEST_F(MeshFileTest, AFileThatIsNoMeshIsRefused) {
  std::ofstream(path("text.vtu")) << "hello";
  EXPECT_NE(error_of_reading(path("text.vtu")), "");
  std::ofstream(path("empty.vtu")) << grid_with("");
  EXPECT_NE(error_of_reading(path("empty.vtu")).find("hermite_nodes is missing"),
            std::string::npos);
}

TEST_F(MeshFileTest, NumbersThatAreNotFiniteAreRefusedInBothDirections) {
  MeshFile file = full_example();
  std::vector<HermiteMesh::Node> nodes = file.mesh.nodes();
  nodes[2](1, 3) = std::numeric_limits<double>::quiet_NaN();
  file.mesh = HermiteMesh(nodes, file.mesh.elements());
  EXPECT_THROW(write_mesh_file(path("nan.vtu"), file), std::invalid_argument);

  std::string array =
      "<DataArray type=\"Float64\" Name=\"hermite_nodes\" NumberOfComponents=\"24\" "
      "NumberOfTuples=\"1\" format=\"ascii\">nan";
  for (int i = 0; i < 23; ++i) array += " 0";
  std::ofstream(path("hand.vtu")) << grid_with(array + "</DataArray>");
  EXPECT_NE(error_of_reading(path("hand.vtu")).find("hand.vtu: array hermite_nodes"),
            std::string::npos)
      << error_of_reading(path("hand.vtu"));
}

TEST_F(MeshFileTest, WrongSizesAreRefused) {
  MeshFile file = full_example();
  file.faces.pop_back();
  EXPECT_THROW(write_mesh_file(path("b.vtu"), file), std::invalid_argument);
  file = full_example();
  file.configurations["prone"].pop_back();
  EXPECT_THROW(write_mesh_file(path("b.vtu"), file), std::invalid_argument);
  file = full_example();
  file.fields["distance_mm"].values.pop_back();
  EXPECT_THROW(write_mesh_file(path("b.vtu"), file), std::invalid_argument);
}

TEST_F(MeshFileTest, AFolderThatCannotBeWrittenIsAnError) {
  EXPECT_THROW(write_mesh_file(path("none/a.vtu"), full_example()), std::runtime_error);
  EXPECT_THROW(write_exf(path("none/a.exf"), full_example().mesh), std::runtime_error);
}

TEST_F(MeshFileTest, ExfHoldsEveryNodeExactlyAndCountsFromOne) {
  const HermiteMesh mesh = full_example().mesh;
  write_exf(path("a.exf"), mesh);
  std::ifstream in(path("a.exf"));
  std::string line;
  std::getline(in, line);
  EXPECT_EQ(line, "EX Version: 2");
  int nodes = 0, elements = 0;
  while (std::getline(in, line)) {
    if (line == "Node: " + std::to_string(nodes + 1)) {
      HermiteMesh::Node node;
      for (int a = 0; a < 3; ++a)
        for (int d = 0; d < 8; ++d) in >> node(a, d);
      EXPECT_EQ(node, mesh.node(nodes++));
    }
    if (line == "Element: " + std::to_string(elements + 1)) {
      std::getline(in, line);
      for (int c = 0; c < 8; ++c) {
        int id;
        in >> id;
        EXPECT_EQ(id, mesh.corners(elements)[c] + 1);
      }
      ++elements;
    }
  }
  EXPECT_EQ(nodes, mesh.num_nodes());
  EXPECT_EQ(elements, mesh.num_elements());
}

}  // namespace
}  // namespace mammotwin
