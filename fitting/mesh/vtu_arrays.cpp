#include "fitting/mesh/vtu_arrays.h"

#include <vtkCallbackCommand.h>
#include <vtkDataArray.h>
#include <vtkDoubleArray.h>
#include <vtkExecutive.h>
#include <vtkIntArray.h>
#include <vtkNew.h>
#include <vtkXMLUnstructuredGridReader.h>
#include <vtkXMLUnstructuredGridWriter.h>

#include <stdexcept>

#include "fitting/mesh/check_vtu.h"

namespace mammotwin {

namespace {

/// Keeps VTK's complaints from the terminal and remembers the first.
vtkSmartPointer<vtkCallbackCommand> remember_errors(std::string& message) {
  auto command = vtkSmartPointer<vtkCallbackCommand>::New();
  command->SetClientData(&message);
  command->SetCallback([](vtkObject*, unsigned long, void* client, void* text) {
    auto& first = *static_cast<std::string*>(client);
    if (first.empty()) first = text ? static_cast<const char*>(text) : "unknown error";
  });
  return command;
}

template <class Array, class T>
void add(vtkFieldData* data, const std::string& name, int components,
         const std::vector<T>& values) {
  vtkNew<Array> array;
  array->SetName(name.c_str());
  array->SetNumberOfComponents(components);
  array->SetNumberOfTuples(static_cast<vtkIdType>(values.size()) / components);
  std::copy(values.begin(), values.end(), array->GetPointer(0));
  data->AddArray(array);
}

}  // namespace

void write_grid(const std::filesystem::path& path, vtkUnstructuredGrid* grid) {
  vtkNew<vtkXMLUnstructuredGridWriter> writer;
  std::string error;
  const auto command = remember_errors(error);
  writer->AddObserver("ErrorEvent", command);
  writer->GetExecutive()->AddObserver("ErrorEvent", command);
  writer->SetFileName(path.c_str());
  writer->SetInputData(grid);
  writer->SetDataModeToBinary();
  if (!writer->Write() || !error.empty())
    throw std::runtime_error(path.string() + ": cannot be written; is the disk full or read-only?");
}

vtkSmartPointer<vtkUnstructuredGrid> read_grid(const std::filesystem::path& path) {
  if (!std::filesystem::is_regular_file(path))
    throw std::runtime_error(path.string() + ": no such file; run the stage that makes it");
  check_vtu(path);
  vtkNew<vtkXMLUnstructuredGridReader> reader;
  std::string error;
  const auto command = remember_errors(error);
  reader->AddObserver("ErrorEvent", command);
  reader->GetExecutive()->AddObserver("ErrorEvent", command);
  reader->SetParserErrorObserver(command);
  reader->SetReaderErrorObserver(command);
  reader->SetFileName(path.c_str());
  reader->Update();
  if (!error.empty() || reader->GetErrorCode() != 0)
    throw std::runtime_error(path.string() +
                             ": is not a whole .vtu file (truncated or of another format); "
                             "make it again");
  return reader->GetOutput();
}

void add_array(vtkFieldData* data, const std::string& name, int components,
               const std::vector<double>& values) {
  add<vtkDoubleArray>(data, name, components, values);
}

void add_array(vtkFieldData* data, const std::string& name, int components,
               const std::vector<int>& values) {
  add<vtkIntArray>(data, name, components, values);
}

bool ArrayReader::has(const std::string& name) const { return data_->GetArray(name.c_str()); }

std::vector<double> ArrayReader::doubles(const std::string& name, int components) const {
  vtkDataArray* array = data_->GetArray(name.c_str());
  if (!array) fail(name, "is missing; expected a mesh written by this program");
  if (array->GetNumberOfComponents() != components)
    fail(name, "has " + std::to_string(array->GetNumberOfComponents()) + " components; expected " +
                   std::to_string(components));
  std::vector<double> values;
  values.reserve(array->GetNumberOfValues());
  for (vtkIdType i = 0; i < array->GetNumberOfTuples(); ++i)
    for (int c = 0; c < components; ++c) values.push_back(array->GetComponent(i, c));
  return values;
}

std::vector<std::string> ArrayReader::names_with_prefix(const std::string& prefix) const {
  std::vector<std::string> names;
  for (int i = 0; i < data_->GetNumberOfArrays(); ++i) {
    const std::string name = data_->GetArrayName(i) ? data_->GetArrayName(i) : "";
    if (name.rfind(prefix, 0) == 0) names.push_back(name.substr(prefix.size()));
  }
  return names;
}

void ArrayReader::fail(const std::string& name, const std::string& problem) const {
  throw std::runtime_error(path_.string() + ": array " + name + " " + problem);
}

}  // namespace mammotwin
