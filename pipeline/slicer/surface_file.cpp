#include "pipeline/slicer/surface_file.h"

#include <vtkCellArray.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPoints.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLPolyDataWriter.h>

#include <stdexcept>

namespace mammotwin {
namespace {

void add_points(vtkPolyData* data, const FaceTriangles& surface) {
  vtkNew<vtkPoints> points;
  for (const Eigen::Vector3d& x : surface.points) points->InsertNextPoint(x.x(), x.y(), x.z());
  data->SetPoints(points);
}

void add_triangles(vtkPolyData* data, const FaceTriangles& surface) {
  vtkNew<vtkCellArray> triangles;
  for (const auto& [a, b, c] : surface.triangles) {
    const vtkIdType corners[] = {a, b, c};
    triangles->InsertNextCell(3, corners);
  }
  data->SetPolys(triangles);
}

void add_numbers(vtkPolyData* data, const PointNumbers& numbers) {
  if (numbers.values.empty()) return;
  vtkNew<vtkDoubleArray> array;
  array->SetName(numbers.name.c_str());
  for (const double value : numbers.values) array->InsertNextValue(value);
  data->GetPointData()->SetScalars(array);
}

void say_space(vtkPolyData* data) {
  vtkNew<vtkStringArray> space;
  space->SetName("SPACE");
  space->InsertNextValue("LPS");
  data->GetFieldData()->AddArray(space);
}

}  // namespace

void write_surface(const std::filesystem::path& path, const FaceTriangles& surface,
                   const PointNumbers& numbers) {
  vtkNew<vtkPolyData> data;
  add_points(data, surface);
  add_triangles(data, surface);
  add_numbers(data, numbers);
  say_space(data);
  vtkNew<vtkXMLPolyDataWriter> writer;
  writer->SetFileName(path.c_str());
  writer->SetInputData(data);
  if (writer->Write() != 1)
    throw std::runtime_error(path.string() + ": cannot be written; is the disk full?");
}

}  // namespace mammotwin
