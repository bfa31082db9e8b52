#pragma once

#include <array>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace mammotwin {

using Point = std::array<double, 3>;  // ITK brings its own Eigen, which must not meet ours

/// A node of a 3D Slicer scene, as VTK's XML parser reads it.
struct SceneNode {
  std::string tag;
  std::map<std::string, std::string> attributes;

  std::string attribute(const std::string& name) const;  ///< empty where there is none
  std::string reference(const std::string& role) const;  ///< id behind "role:" in `references`
  std::vector<std::string> references() const;           ///< all ids in it
};

/// The items of the data tree among them. Throws std::runtime_error where the file is no XML.
std::vector<SceneNode> read_scene(const std::filesystem::path& path);
SceneNode node_with_id(const std::vector<SceneNode>& nodes, const std::string& id);

struct ReadSurface {
  std::vector<Point> points;
  int triangles = 0;
  std::string space;    ///< what its field "SPACE" says
  std::string numbers;  ///< name of its point numbers
};
ReadSurface read_surface_with_vtk(const std::filesystem::path& path);

/// A point as ITK's displacement field transform over the file moves it.
Point transformed_by_itk(const std::filesystem::path& field, const Point& x);

struct ReadGrid {
  std::array<int, 3> size;
  Point origin;
};
ReadGrid read_grid_with_itk(const std::filesystem::path& path);

}  // namespace mammotwin
