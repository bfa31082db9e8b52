#include "fitting/surface/flatten.h"

#include <CGAL/Eigen_solver_traits.h>
#include <CGAL/Polygon_mesh_processing/measure.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_parameterization/Discrete_conformal_map_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/Square_border_parameterizer_3.h>
#include <CGAL/Surface_mesh_parameterization/parameterize.h>

#include <Eigen/UmfPackSupport>
#include <algorithm>
#include <stdexcept>

#include "fitting/one_blas_thread.h"

namespace mammotwin {

namespace {

namespace parameterization = CGAL::Surface_mesh_parameterization;
using Kernel = CGAL::Simple_cartesian<double>;
using SurfaceMesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Vertex = SurfaceMesh::Vertex_index;
using Border = parameterization::Square_border_arc_length_parameterizer_3<SurfaceMesh>;
// CGAL's default, BiCGSTAB on an incomplete LU, can leave NaN without a word.
using Solver =
    CGAL::Eigen_solver_traits<Eigen::UmfPackLU<CGAL::Eigen_sparse_matrix<double>::EigenType>>;
using Harmonic =
    parameterization::Discrete_conformal_map_parameterizer_3<SurfaceMesh, Border, Solver>;

/// Corners in the order (x_min, z_min), (x_max, z_min), (x_max, z_max), (x_min, z_max).
Eigen::Vector2d corner(const BreastRegion& r, int c) {
  return {c == 1 || c == 2 ? r.x_max : r.x_min, c >= 2 ? r.z_max : r.z_min};
}

/// Places in the loop where it passes corner c.
std::vector<int> visits(const TriangleSurface& skin, const std::vector<int>& loop,
                        const BreastRegion& region, int c) {
  const Eigen::Vector2d at = corner(region, c);
  std::vector<int> places;
  for (std::size_t i = 0; i < loop.size(); ++i) {
    const Eigen::Vector3d& v = skin.vertices[loop[i]];
    if (v.x() == at.x() && v.z() == at.y()) places.push_back(static_cast<int>(i));
  }
  return places;
}

/// The part of a closed loop from one place to another, both included.
std::vector<int> stretch(const std::vector<int>& loop, int from, int to) {
  std::vector<int> part;
  const int n = static_cast<int>(loop.size());
  for (int i = from; i != to; i = (i + 1) % n) part.push_back(loop[i]);
  part.push_back(loop[to]);
  return part;
}

SurfaceMesh to_cgal(const TriangleSurface& skin) {
  SurfaceMesh mesh;
  for (const auto& v : skin.vertices) mesh.add_vertex({v.x(), v.y(), v.z()});
  for (const auto& t : skin.triangles)
    if (mesh.add_face(Vertex(t[0]), Vertex(t[1]), Vertex(t[2])) == SurfaceMesh::null_face())
      throw std::runtime_error("the skin surface is not a manifold; are the labels full of holes?");
  return mesh;
}

/// The loop turned so that it begins at corner 0 and goes to corner 1 next.
std::vector<int> from_corner_0_to_1(const TriangleSurface& skin, const BreastRegion& region) {
  std::vector<int> loop = boundary_loops(skin).front();
  std::rotate(loop.begin(), loop.begin() + visits(skin, loop, region, 0).front(), loop.end());
  if (visits(skin, loop, region, 1).front() > visits(skin, loop, region, 3).front())
    std::reverse(loop.begin() + 1, loop.end());
  return loop;
}

}  // namespace

std::string why_not_a_square(const TriangleSurface& skin, const BreastRegion& region) {
  if (skin.triangles.empty()) return "it is empty";
  const int euler = euler_characteristic(skin);
  if (euler != 1)
    return "it is not a disc (Euler characteristic " + std::to_string(euler) + ", expected 1)";
  const auto loops = boundary_loops(skin);
  if (loops.size() != 1) return "its boundary has " + std::to_string(loops.size()) + " loops";
  for (int c = 0; c < 4; ++c) {
    const auto count = visits(skin, loops[0], region, c).size();
    if (count != 1)
      return "its boundary passes a corner of the region " + std::to_string(count) +
             " times, expected once";
  }
  return "";
}

FlatSkin flatten(const TriangleSurface& skin, const BreastRegion& region) {
  if (const std::string reason = why_not_a_square(skin, region); !reason.empty())
    throw std::runtime_error("the skin surface cannot be laid on a square: " + reason);
  const std::vector<int> loop = from_corner_0_to_1(skin, region);
  std::array<int, 4> place;
  for (int c = 0; c < 4; ++c) place[c] = visits(skin, loop, region, c).front();

  FlatSkin flat;
  flat.edges[2] = stretch(loop, place[0], place[1]);
  flat.edges[1] = stretch(loop, place[1], place[2]);
  flat.edges[3] = stretch(loop, place[2], place[3]);
  flat.edges[0] = stretch(loop, place[3], place[0]);
  std::reverse(flat.edges[3].begin(), flat.edges[3].end());
  std::reverse(flat.edges[0].begin(), flat.edges[0].end());

  SurfaceMesh mesh = to_cgal(skin);
  auto uv = mesh.add_property_map<Vertex, Kernel::Point_2>("v:uv").first;
  auto border = CGAL::Polygon_mesh_processing::longest_border(mesh).first;
  // CGAL lays the first of the four that it meets at (0, 0).
  while (static_cast<int>(mesh.source(border)) != loop[place[0]]) border = mesh.next(border);
  // CGAL wants the corners in the order in which its border passes them.
  const auto passes = [&](auto h, int c) {
    return static_cast<int>(mesh.target(h)) == loop[place[c]];
  };
  auto next = border;
  while (!passes(next, 1) && !passes(next, 3)) next = mesh.next(next);
  const bool swapped = passes(next, 3);
  const auto vertex = [&](int c) { return Vertex(loop[place[c]]); };
  const Border square(vertex(0), vertex(swapped ? 3 : 1), vertex(2), vertex(swapped ? 1 : 3));
  const OneBlasThread one_thread;  // UMFPACK's last bits depend on the number
  const auto error = parameterization::parameterize(mesh, Harmonic(square), border, uv);
  if (error != parameterization::OK)
    throw std::runtime_error(
        std::string("the skin surface cannot be laid on a square: ") +
        (error == parameterization::ERROR_CANNOT_SOLVE_LINEAR_SYSTEM
             ? "its triangles are degenerate"  // for which CGAL 5.5 has another code's words
             : parameterization::get_error_message(error)));
  for (Vertex v : mesh.vertices())
    flat.uv.push_back(swapped ? Eigen::Vector2d(uv[v].y(), uv[v].x())
                              : Eigen::Vector2d(uv[v].x(), uv[v].y()));
  for (const Eigen::Vector2d& uv : flat.uv)
    if (!uv.allFinite())
      throw std::runtime_error(
          "the skin surface cannot be laid on a square: its triangles are degenerate");
  return flat;
}

}  // namespace mammotwin
