#include "fitting/scan/scan_surface.h"

#include <CGAL/Advancing_front_surface_reconstruction.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Polygon_mesh_processing/border.h>
#include <CGAL/Polygon_mesh_processing/connected_components.h>
#include <CGAL/Polygon_mesh_processing/manifoldness.h>
#include <CGAL/Polygon_mesh_processing/orient_polygon_soup.h>
#include <CGAL/Polygon_mesh_processing/polygon_soup_to_polygon_mesh.h>
#include <CGAL/Polygon_mesh_processing/triangulate_hole.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/boost/graph/Euler_operations.h>

#include <stdexcept>

namespace mammotwin {

namespace {

namespace processing = CGAL::Polygon_mesh_processing;
using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Halfedge = Mesh::Halfedge_index;

constexpr double longest_edge_mm = 6;  // four times the spacing of cleaned points

double longest_edge(const Mesh& mesh, Mesh::Face_index face) {
  double longest = 0;
  for (Halfedge h : CGAL::halfedges_around_face(mesh.halfedge(face), mesh))
    longest = std::max(
        longest, CGAL::squared_distance(mesh.point(mesh.source(h)), mesh.point(mesh.target(h))));
  return std::sqrt(longest);
}

/// The front bridges holes by long flat triangles; they are to be filled fairly.
void open_holes(Mesh& mesh) {
  std::vector<Mesh::Face_index> bridges;
  for (auto face : mesh.faces())
    if (longest_edge(mesh, face) > longest_edge_mm) bridges.push_back(face);
  for (auto face : bridges) CGAL::Euler::remove_face(mesh.halfedge(face), mesh);
  processing::duplicate_non_manifold_vertices(mesh);
}

Mesh joined(const std::vector<Eigen::Vector3d>& points) {
  std::vector<Kernel::Point_3> soup;
  for (const auto& x : points) soup.emplace_back(x.x(), x.y(), x.z());
  std::vector<std::array<std::size_t, 3>> triangles;
  CGAL::advancing_front_surface_reconstruction(soup.begin(), soup.end(),
                                               std::back_inserter(triangles));
  processing::orient_polygon_soup(soup, triangles);
  Mesh mesh;
  processing::polygon_soup_to_polygon_mesh(soup, triangles, mesh);
  open_holes(mesh);
  processing::keep_largest_connected_components(mesh, 1);
  mesh.collect_garbage();
  return mesh;
}

double length(const Mesh& mesh, Halfedge border) {
  double sum = 0;
  for (Halfedge h : CGAL::halfedges_around_face(border, mesh))
    sum +=
        std::sqrt(CGAL::squared_distance(mesh.point(mesh.source(h)), mesh.point(mesh.target(h))));
  return sum;
}

/// Fills all borders but the longest; returns how many.
int fill_holes(Mesh& mesh) {
  std::vector<Halfedge> borders;
  processing::extract_boundary_cycles(mesh, std::back_inserter(borders));
  if (borders.empty())
    throw std::runtime_error("the scan closes on itself; expected a skin with an outer rim");
  const auto longest =
      *std::max_element(borders.begin(), borders.end(),
                        [&](Halfedge a, Halfedge b) { return length(mesh, a) < length(mesh, b); });
  int holes = 0;
  for (Halfedge border : borders) {
    if (border == longest) continue;
    std::vector<Mesh::Face_index> faces;
    std::vector<Mesh::Vertex_index> vertices;
    processing::triangulate_refine_and_fair_hole(mesh, border, std::back_inserter(faces),
                                                 std::back_inserter(vertices));
    ++holes;
  }
  return holes;
}

TriangleSurface plain(const Mesh& mesh) {
  TriangleSurface surface;
  for (auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    surface.vertices.emplace_back(p.x(), p.y(), p.z());
  }
  for (auto f : mesh.faces()) {
    std::array<int, 3> triangle;
    int i = 0;
    for (auto v : CGAL::vertices_around_face(mesh.halfedge(f), mesh))
      triangle[i++] = static_cast<int>(v);
    surface.triangles.push_back(triangle);
  }
  return surface;
}

}  // namespace

ScanSurface scan_surface(const std::vector<Eigen::Vector3d>& points) {
  Mesh mesh = joined(points);
  ScanSurface result;
  result.holes = fill_holes(mesh);
  mesh.collect_garbage();
  result.surface = plain(mesh);
  const int euler = euler_characteristic(result.surface);
  const auto loops = boundary_loops(result.surface);
  if (euler != 1 || loops.size() != 1)
    throw std::runtime_error(
        "the scan's points do not join to one sheet of skin (Euler "
        "characteristic " +
        std::to_string(euler) +
        ", expected 1): are there "
        "too few points, or two layers of them?");
  result.rim = loops.front();
  return result;
}

}  // namespace mammotwin
