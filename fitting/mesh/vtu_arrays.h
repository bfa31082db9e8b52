#pragma once

#include <vtkFieldData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include <filesystem>
#include <string>
#include <vector>

namespace mammotwin {

/// Writes VTK XML, binary and compressed. Throws std::runtime_error if it cannot.
void write_grid(const std::filesystem::path& path, vtkUnstructuredGrid* grid);

/// Reads VTK XML. Throws std::runtime_error if the file is missing, truncated or not XML.
vtkSmartPointer<vtkUnstructuredGrid> read_grid(const std::filesystem::path& path);

void add_array(vtkFieldData* data, const std::string& name, int components,
               const std::vector<double>& values);
void add_array(vtkFieldData* data, const std::string& name, int components,
               const std::vector<int>& values);

/// Named arrays of a file; what is missing or misshapen is reported with the file's name.
class ArrayReader {
 public:
  ArrayReader(std::filesystem::path path, vtkFieldData* data)
      : path_(std::move(path)), data_(data) {}

  bool has(const std::string& name) const;

  /// All values, a tuple's components together. Throws if absent or of another width.
  std::vector<double> doubles(const std::string& name, int components) const;

  /// What follows the prefix in the names that begin with it.
  std::vector<std::string> names_with_prefix(const std::string& prefix) const;

  [[noreturn]] void fail(const std::string& name, const std::string& problem) const;

 private:
  std::filesystem::path path_;
  vtkFieldData* data_;
};

}  // namespace mammotwin
