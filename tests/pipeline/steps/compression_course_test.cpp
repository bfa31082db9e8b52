// The load steps of a compression, kept in its mesh and read by VTK from what is written for
// ParaView.

#include "pipeline/steps/compression_course.h"

#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUtilities.h>

#include "tests/pipeline/scratch_folder.h"
#include "tests/solver/dome_breast.h"

namespace mammotwin {
namespace {

class CompressionCourse : public ScratchFolder {
 protected:
  void SetUp() override {
    CompressionProblem problem = dome_problem(80);
    problem.mesh = dome_breast({3, 3, 1});
    CompressionOptions options;
    options.longest_move = 3;
    const CompressionResult result = compress(problem, options);
    ASSERT_TRUE(result.report.usable()) << result.report.reason;
    report_ = result.report;
    compressed_ = problem.mesh;
    compressed_.configurations["prone"] = problem.mesh.mesh.nodes();
    compressed_.mesh = HermiteMesh(result.deformed, problem.mesh.mesh.elements());
    remember_course(report_, compressed_);
  }

  CompressionReport report_;
  MeshFile compressed_{HermiteMesh({}, {}), {}, {}, {}, {}, {}};
};

TEST_F(CompressionCourse, ComesBackFromTheFile) {
  write_mesh_file(folder_ / "cc.vtu", compressed_);
  const MeshFile read = read_mesh_file(folder_ / "cc.vtu");
  const std::vector<CourseStep> course = course_of(read);
  ASSERT_GE(report_.history.size(), 3u);
  ASSERT_EQ(course.size(), report_.history.size() + 1);
  EXPECT_EQ(course.front().nodes, compressed_.configurations.at("prone"));
  EXPECT_EQ(course.front().thickness_mm, report_.free_thickness_mm);
  for (std::size_t s = 1; s + 1 < course.size(); ++s) {
    EXPECT_EQ(course[s].nodes, report_.history[s - 1].deformed);
    EXPECT_EQ(course[s].thickness_mm, report_.history[s - 1].thickness_mm);
  }
  EXPECT_EQ(course.back().nodes, compressed_.mesh.nodes());
  EXPECT_EQ(course.back().thickness_mm, report_.thickness_mm);
}

TEST_F(CompressionCourse, IsEmptyForAFileWithoutOneAndRefusesADamagedOne) {
  compressed_.metadata["course_nodes"].pop_back();
  EXPECT_THROW(course_of(compressed_), std::runtime_error);
  compressed_.metadata.erase("course_nodes");
  EXPECT_TRUE(course_of(compressed_).empty());
}

TEST_F(CompressionCourse, IsASeriesThatVtkReads) {
  const std::vector<CourseStep> course = course_of(compressed_);
  write_course(compressed_, course, "cc_course", folder_ / "cc_course.pvd",
               [&](const std::string& name) { return folder_ / name; });
  const auto root = vtkSmartPointer<vtkXMLDataElement>::Take(
      vtkXMLUtilities::ReadElementFromFile((folder_ / "cc_course.pvd").c_str()));
  ASSERT_TRUE(root);
  vtkXMLDataElement* list = root->FindNestedElementWithName("Collection");
  ASSERT_TRUE(list);
  ASSERT_EQ(list->GetNumberOfNestedElements(), static_cast<int>(course.size()));
  for (int s = 0; s < list->GetNumberOfNestedElements(); ++s) {
    vtkXMLDataElement* item = list->GetNestedElement(s);
    double time = 0;
    ASSERT_TRUE(item->GetScalarAttribute("timestep", time));
    EXPECT_EQ(time, s);
    vtkNew<vtkXMLUnstructuredGridReader> reader;
    reader->SetFileName((folder_ / item->GetAttribute("file")).c_str());
    reader->Update();
    ASSERT_EQ(reader->GetOutput()->GetNumberOfCells(), compressed_.mesh.num_elements());
    vtkDataArray* moved = reader->GetOutput()->GetPointData()->GetArray("displacement_from_prone");
    ASSERT_TRUE(moved);
    EXPECT_EQ(moved->GetMaxNorm() > 0, course[s].nodes != course[0].nodes);
    vtkDataArray* thickness =
        reader->GetOutput()->GetFieldData()->GetArray("metadata:thickness_mm");
    ASSERT_TRUE(thickness);
    EXPECT_EQ(thickness->GetTuple1(0), course[s].thickness_mm);
  }
  EXPECT_NE(course.back().nodes, course.front().nodes);
}

}  // namespace
}  // namespace mammotwin
