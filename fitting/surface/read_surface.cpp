#include "fitting/surface/read_surface.h"

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/Simple_cartesian.h>

#include <stdexcept>

#include "fitting/surface/check_surface_file.h"

namespace mammotwin {

TriangleSurface read_surface(const std::filesystem::path& path) {
  check_surface_file(path);
  using Point = CGAL::Simple_cartesian<double>::Point_3;
  std::vector<Point> points;
  std::vector<std::vector<std::size_t>> polygons;
  if (!CGAL::IO::read_polygon_soup(path.string(), points, polygons))
    throw std::runtime_error(path.string() +
                             ": cannot be read as a surface; expected PLY, STL, OBJ or OFF");
  TriangleSurface surface;
  for (const Point& p : points) {
    surface.vertices.emplace_back(p.x(), p.y(), p.z());
    if (!surface.vertices.back().allFinite())
      throw std::runtime_error(path.string() + ": a coordinate is not a finite number");
  }
  for (const auto& polygon : polygons) {
    for (const std::size_t vertex : polygon)
      if (vertex >= points.size())
        throw std::runtime_error(path.string() + ": a face names vertex " + std::to_string(vertex) +
                                 " of " + std::to_string(points.size()) + "; export it again");
    for (std::size_t k = 2; k < polygon.size(); ++k)
      surface.triangles.push_back({static_cast<int>(polygon[0]), static_cast<int>(polygon[k - 1]),
                                   static_cast<int>(polygon[k])});
  }
  if (surface.triangles.empty()) throw std::runtime_error(path.string() + ": holds no triangle");
  return surface;
}

}  // namespace mammotwin
