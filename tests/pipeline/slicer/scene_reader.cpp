#include "tests/pipeline/slicer/scene_reader.h"

#include <itkDisplacementFieldTransform.h>
#include <itkImageFileReader.h>
#include <itkNrrdImageIOFactory.h>
#include <vtkFieldData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>
#include <vtkStringArray.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLPolyDataReader.h>
#include <vtkXMLUtilities.h>

#include <sstream>
#include <stdexcept>

namespace mammotwin {
namespace {

/// "storage:id1;display:id2;" -> (role, id) pairs.
std::vector<std::pair<std::string, std::string>> roles(const std::string& references) {
  std::vector<std::pair<std::string, std::string>> list;
  std::istringstream in(references);
  for (std::string part; std::getline(in, part, ';');)
    if (const auto colon = part.find(':'); colon != std::string::npos)
      list.emplace_back(part.substr(0, colon), part.substr(colon + 1));
  return list;
}

template <class Image>
typename Image::Pointer read_with_itk(const std::filesystem::path& path) {
  itk::NrrdImageIOFactory::RegisterOneFactory();
  const auto reader = itk::ImageFileReader<Image>::New();
  reader->SetFileName(path.string());
  reader->Update();
  return reader->GetOutput();
}

}  // namespace

std::string SceneNode::attribute(const std::string& name) const {
  const auto found = attributes.find(name);
  return found == attributes.end() ? "" : found->second;
}

std::string SceneNode::reference(const std::string& role) const {
  for (const auto& [its_role, id] : roles(attribute("references")))
    if (its_role == role) return id;
  return "";
}

std::vector<std::string> SceneNode::references() const {
  std::vector<std::string> ids;
  for (const auto& [role, id] : roles(attribute("references"))) ids.push_back(id);
  if (!attribute("dataNode").empty()) ids.push_back(attribute("dataNode"));
  if (!attribute("backgroundVolumeID").empty()) ids.push_back(attribute("backgroundVolumeID"));
  return ids;
}

namespace {

/// Elements in the order of the file, items of the data tree after what they lie in.
void append_below(vtkXMLDataElement& parent, std::vector<SceneNode>& nodes) {
  for (int n = 0; n < parent.GetNumberOfNestedElements(); ++n) {
    vtkXMLDataElement* element = parent.GetNestedElement(n);
    SceneNode node{element->GetName(), {}};
    for (int a = 0; a < element->GetNumberOfAttributes(); ++a)
      node.attributes[element->GetAttributeName(a)] = element->GetAttributeValue(a);
    nodes.push_back(node);
    append_below(*element, nodes);
  }
}

}  // namespace

std::vector<SceneNode> read_scene(const std::filesystem::path& path) {
  vtkSmartPointer<vtkXMLDataElement> root;
  root.TakeReference(vtkXMLUtilities::ReadElementFromFile(path.c_str()));
  if (!root || std::string(root->GetName()) != "MRML") throw std::runtime_error("no MRML scene");
  std::vector<SceneNode> nodes;
  append_below(*root, nodes);
  return nodes;
}

SceneNode node_with_id(const std::vector<SceneNode>& nodes, const std::string& id) {
  for (const SceneNode& node : nodes)
    if (node.attribute("id") == id) return node;
  throw std::runtime_error("no node has the id " + id);
}

ReadSurface read_surface_with_vtk(const std::filesystem::path& path) {
  vtkNew<vtkXMLPolyDataReader> reader;
  reader->SetFileName(path.c_str());
  reader->Update();
  vtkPolyData* data = reader->GetOutput();
  ReadSurface surface;
  for (vtkIdType n = 0; n < data->GetNumberOfPoints(); ++n)
    surface.points.push_back({data->GetPoint(n)[0], data->GetPoint(n)[1], data->GetPoint(n)[2]});
  surface.triangles = static_cast<int>(data->GetNumberOfPolys());
  if (auto* space = vtkStringArray::SafeDownCast(data->GetFieldData()->GetAbstractArray("SPACE")))
    surface.space = space->GetValue(0);
  if (data->GetPointData()->GetScalars())
    surface.numbers = data->GetPointData()->GetScalars()->GetName();
  return surface;
}

Point transformed_by_itk(const std::filesystem::path& field, const Point& x) {
  using Transform = itk::DisplacementFieldTransform<double, 3>;
  const auto transform = Transform::New();
  transform->SetDisplacementField(read_with_itk<Transform::DisplacementFieldType>(field));
  Transform::InputPointType point;
  for (int i = 0; i < 3; ++i) point[i] = x[i];
  const auto moved = transform->TransformPoint(point);
  return {moved[0], moved[1], moved[2]};
}

ReadGrid read_grid_with_itk(const std::filesystem::path& path) {
  const auto image = read_with_itk<itk::Image<float, 3>>(path);
  const auto size = image->GetLargestPossibleRegion().GetSize();
  const auto origin = image->GetOrigin();
  return {{static_cast<int>(size[0]), static_cast<int>(size[1]), static_cast<int>(size[2])},
          {origin[0], origin[1], origin[2]}};
}

}  // namespace mammotwin
