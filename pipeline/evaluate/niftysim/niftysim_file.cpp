#include "pipeline/evaluate/niftysim/niftysim_file.h"

#include <vtkNew.h>
#include <vtkPoints.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>
#include <vtkUnstructuredGridReader.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLUtilities.h>

#include <numeric>
#include <sstream>
#include <stdexcept>
#include <string>

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

/// An entry of the file that can say where it stands.
class Entry {
 public:
  Entry(vtkXMLDataElement* element, std::string where)
      : element_(element), where_(std::move(where)) {}

  Entry child(const char* name) const {
    vtkXMLDataElement* found = element_->FindNestedElementWithName(name);
    if (!found) throw std::runtime_error(where_ + ": there is no " + name);
    return {found, where_ + ": " + name};
  }
  std::vector<Entry> children(const std::string& name) const {
    std::vector<Entry> found;
    for (int i = 0; i < element_->GetNumberOfNestedElements(); ++i)
      if (vtkXMLDataElement* e = element_->GetNestedElement(i); name == e->GetName())
        found.emplace_back(e, where_ + ": " + name);
    return found;
  }
  std::string attribute(const char* name) const {
    const char* text = element_->GetAttribute(name);
    return text ? text : "";
  }
  void expect(const char* name, const std::string& value) const {
    if (attribute(name) != value)
      throw std::runtime_error(where_ + ": " + name + " is \"" + attribute(name) + "\"; expected " +
                               value);
  }
  /// Every number of the text; a multiple of `group` of them.
  template <class Number>
  std::vector<Number> numbers(std::size_t group = 1) const {
    std::istringstream text(element_->GetCharacterData());
    std::vector<Number> all;
    for (Number n; text >> n;) all.push_back(n);
    if (!text.eof() || all.empty() || all.size() % group != 0)
      throw std::runtime_error(where_ + ": holds " + std::to_string(all.size()) +
                               " numbers; expected a multiple of " + std::to_string(group));
    return all;
  }
  Eigen::Vector3d point() const {
    const auto x = numbers<double>(3);
    return {x[0], x[1], x[2]};
  }

 private:
  vtkXMLDataElement* element_;
  std::string where_;
};

void read_mesh(const Entry& root, NiftySimModel& model) {
  const auto x = root.child("Nodes").numbers<double>(3);
  for (std::size_t n = 0; n < x.size(); n += 3) model.nodes.emplace_back(x[n], x[n + 1], x[n + 2]);
  const Entry elements = root.child("Elements");
  elements.expect("Type", "T4");
  const auto c = elements.numbers<int>(4);
  for (std::size_t n = 0; n < c.size(); n += 4)
    model.tetrahedra.push_back({c[n], c[n + 1], c[n + 2], c[n + 3]});
}

void read_sets(const Entry& root, NiftySimModel& model) {
  for (const Entry& set : root.children("ElementSet")) {
    const Entry material = set.child("Material");
    material.expect("Type", "NH");
    const auto parameters = material.child("ElasticParams").numbers<double>(2);
    model.sets.push_back({set.numbers<int>(), parameters[0], parameters[1]});
  }
}

void read_constraints(const Entry& root, NiftySimModel& model) {
  for (const Entry& constraint : root.children("Constraint")) {
    if (constraint.attribute("Type") == "Fix") {
      model.fixed_component = std::stoi(constraint.attribute("DOF"));
      model.fixed_nodes = constraint.child("Nodes").numbers<int>();
    } else {
      constraint.expect("Type", "Gravity");
      model.gravity = constraint.child("AccelerationMagnitude").numbers<double>().front() *
                      constraint.child("AccelerationDirection").point();
    }
  }
  for (const Entry& plate : root.children("ContactPlate"))
    model.plates.push_back({plate.child("a").point(), plate.child("Disp").point()});
}

}  // namespace

NiftySimModel read_niftysim_model(const fs::path& file) {
  const auto tree =
      vtkSmartPointer<vtkXMLDataElement>::Take(vtkXMLUtilities::ReadElementFromFile(file.c_str()));
  if (!tree) throw std::runtime_error(file.string() + ": is not there or no XML");
  const Entry root(tree, file.string());
  NiftySimModel model;
  model.density = root.child("SystemParams").child("Density").numbers<double>().front();
  read_mesh(root, model);
  read_sets(root, model);
  read_constraints(root, model);
  return model;
}

std::vector<Eigen::Vector3d> read_vtk_points(const fs::path& file) {
  if (!fs::exists(file)) throw std::runtime_error(file.string() + ": no such file");
  vtkNew<vtkUnstructuredGridReader> reader;
  reader->SetFileName(file.c_str());
  reader->Update();
  std::vector<Eigen::Vector3d> points;
  for (vtkIdType n = 0; n < reader->GetOutput()->GetNumberOfPoints(); ++n)
    points.emplace_back(reader->GetOutput()->GetPoint(n));
  return points;
}

}  // namespace mammotwin
