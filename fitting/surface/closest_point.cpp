#include "fitting/surface/closest_point.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Simple_cartesian.h>

#include <Eigen/Geometry>

namespace mammotwin {

using Kernel = CGAL::Simple_cartesian<double>;
using Triangles = std::vector<Kernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;

struct ClosestPoint::Tree {
  Triangles triangles;
  std::vector<int> index;  ///< of each triangle in the surface
  CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>> tree;
};

namespace {

Kernel::Point_3 to_cgal(const Eigen::Vector3d& x) { return {x.x(), x.y(), x.z()}; }
Eigen::Vector3d from_cgal(const Kernel::Point_3& x) { return {x.x(), x.y(), x.z()}; }

}  // namespace

ClosestPoint::ClosestPoint(const TriangleSurface& surface) : tree_(std::make_unique<Tree>()) {
  for (std::size_t t = 0; t < surface.triangles.size(); ++t) {
    if (surface.area_vector(static_cast<int>(t)).squaredNorm() == 0) continue;
    const auto& v = surface.triangles[t];
    tree_->index.push_back(static_cast<int>(t));
    tree_->triangles.emplace_back(to_cgal(surface.vertices[v[0]]), to_cgal(surface.vertices[v[1]]),
                                  to_cgal(surface.vertices[v[2]]));
  }
  tree_->tree.insert(tree_->triangles.cbegin(), tree_->triangles.cend());
  tree_->tree.build();
  tree_->tree.accelerate_distance_queries();
}

ClosestPoint::~ClosestPoint() = default;

ClosestPoint::Hit ClosestPoint::operator()(const Eigen::Vector3d& x) const {
  const auto [point, triangle] = tree_->tree.closest_point_and_primitive(to_cgal(x));
  const Eigen::Vector3d a = from_cgal((*triangle)[0]), b = from_cgal((*triangle)[1]),
                        c = from_cgal((*triangle)[2]);
  return {from_cgal(point), (b - a).cross(c - a).normalized(),
          tree_->index[triangle - tree_->triangles.cbegin()]};
}

}  // namespace mammotwin
