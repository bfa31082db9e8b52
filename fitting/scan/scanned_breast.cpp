#include "fitting/scan/scanned_breast.h"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <tbb/parallel_for.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <stdexcept>

#include "fitting/scan/scan_surface.h"
#include "segmentation/body/breast_region.h"
#include "segmentation/body/most_anterior_point.h"

namespace mammotwin {

namespace {

constexpr double voxel_mm = 1;
constexpr double margin_mm = 5;   // of air in front, of muscle behind
constexpr double steepest = 0.2;  // cosine: `up` nearer to the base's normal than 78 degrees

struct Plane {
  Eigen::Vector3d point, normal;  ///< normal of length 1, from the base to the breast's tip
};

Eigen::Vector3d mean_of(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (const auto& x : points) sum += x;
  return sum / static_cast<double>(points.size());
}

Plane plane_through(const std::vector<Eigen::Vector3d>& points) {
  const Eigen::Vector3d mean = mean_of(points);
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const auto& x : points) covariance += (x - mean) * (x - mean).transpose();
  return {mean, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvectors().col(0)};
}

Plane base_of(const ScanSurface& scan, const ScannedSkinOptions& o) {
  Plane base;
  if (o.base_point && o.base_normal) {
    base = {o.unit_mm * *o.base_point, o.base_normal->normalized()};
  } else {
    std::vector<Eigen::Vector3d> rim;
    for (int v : scan.rim) rim.push_back(scan.surface.vertices[v]);
    base = plane_through(rim);
  }
  if (base.normal.dot(mean_of(scan.surface.vertices) - base.point) < 0) base.normal *= -1;
  if (!o.base_point) base.point -= o.base_depth_mm * base.normal;
  return base;
}

/// Moves the surface to the frame whose y runs against the base's normal.
Eigen::Isometry3d bring_to_frame(const Plane& base, const Eigen::Vector3d& up, ScanSurface& scan) {
  const Eigen::Vector3d y = -base.normal;
  const Eigen::Vector3d z = (up - up.dot(y) * y);
  if (z.norm() < steepest * up.norm())
    throw std::runtime_error(
        "scan.up points along the normal of the base plane; expected the "
        "direction to the head in the file's axes");
  Eigen::Matrix3d axes;
  axes << y.cross(z.normalized()).transpose(), y.transpose(), z.normalized().transpose();
  Eigen::Vector3d middle = Eigen::Vector3d::Zero();
  for (int v : scan.rim) middle += scan.surface.vertices[v] / static_cast<double>(scan.rim.size());
  Eigen::Isometry3d frame = Eigen::Isometry3d::Identity();
  frame.linear() = axes;
  frame.translation() = -axes * middle;
  frame.translation().y() = -axes.row(1).dot(base.point);
  for (auto& x : scan.surface.vertices) x = frame * x;
  // Triangles turn so that their normals leave the breast: the mean one points to -y.
  Eigen::Vector3d area = Eigen::Vector3d::Zero();
  for (std::size_t t = 0; t < scan.surface.triangles.size(); ++t)
    area += scan.surface.area_vector(static_cast<int>(t));
  if (area.y() > 0)
    for (auto& t : scan.surface.triangles) std::swap(t[1], t[2]);
  return frame;
}

/// Where lines along y meet the surface.
class Columns {
 public:
  explicit Columns(const TriangleSurface& surface) {
    for (const auto& t : surface.triangles)
      triangles_.emplace_back(point(surface.vertices[t[0]]), point(surface.vertices[t[1]]),
                              point(surface.vertices[t[2]]));
    tree_.insert(triangles_.cbegin(), triangles_.cend());
    tree_.build();
  }

  /// y of every crossing at (x, z), ascending.
  std::vector<double> operator()(double x, double z) const {
    // Off the axis by no simple fraction, so that no edge is met exactly.
    constexpr double off = 1.234567e-5;
    const Kernel::Line_3 line(Kernel::Point_3(x + off, 0, z + 0.7 * off),
                              Kernel::Vector_3(0, 1, 0));
    std::vector<typename Tree::template Intersection_and_primitive_id<Kernel::Line_3>::Type> hits;
    tree_.all_intersections(line, std::back_inserter(hits));
    std::vector<double> ys;
    for (const auto& hit : hits)
      if (const auto* p = boost::get<Kernel::Point_3>(&hit.first)) ys.push_back(p->y());
    std::sort(ys.begin(), ys.end());
    return ys;
  }

 private:
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Triangles = std::vector<Kernel::Triangle_3>;
  using Primitive = CGAL::AABB_triangle_primitive<Kernel, Triangles::const_iterator>;
  using Tree = CGAL::AABB_tree<CGAL::AABB_traits<Kernel, Primitive>>;

  static Kernel::Point_3 point(const Eigen::Vector3d& x) { return {x.x(), x.y(), x.z()}; }

  Triangles triangles_;
  Tree tree_;
};

/// Fat between skin and base, muscle behind it, in the columns that the scan covers.
Volume<std::uint8_t> labels_under(const TriangleSurface& skin) {
  Eigen::Vector3d low = skin.vertices[0], high = skin.vertices[0];
  for (const auto& x : skin.vertices) low = low.cwiseMin(x), high = high.cwiseMax(x);
  low.y() -= margin_mm;
  // Voxel faces lie in the base plane.
  low = (low / voxel_mm).array().floor() * voxel_mm + voxel_mm / 2;
  high.y() = margin_mm;
  const Eigen::Vector3i size =
      ((high - low) / voxel_mm).array().ceil().matrix().cast<int>() + Eigen::Vector3i::Ones();
  Volume<std::uint8_t> labels(size, Eigen::Vector3d::Constant(voxel_mm), low, label::air);
  const Columns columns(skin);
  tbb::parallel_for(0, size.z(), [&](int k) {
    for (int i = 0; i < size.x(); ++i) {
      const Eigen::Vector3d column = labels.position(i, 0, k);
      const std::vector<double> ys = columns(column.x(), column.z());
      if (ys.size() % 2 == 0) continue;
      for (int j = 0; j < size.y(); ++j) {
        const double y = labels.position(i, j, k).y();
        const auto before = std::lower_bound(ys.begin(), ys.end(), y) - ys.begin();
        if (y > 0)
          labels(i, j, k) = label::muscle;
        else if (before % 2)
          labels(i, j, k) = label::fat;
      }
    }
  });
  return labels;
}

}  // namespace

ScannedBreast read_scanned_breast(const std::filesystem::path& path, const ScannedSkinOptions& o) {
  const std::vector<Eigen::Vector3d> raw = read_scan_points(path, o.unit_mm);
  const ScanCloud cloud = clean_scan(raw);
  ScannedBreast result;
  result.points = static_cast<int>(raw.size());
  result.outliers = cloud.outliers;
  try {
    ScanSurface scan = scan_surface(cloud.points);
    result.frame_from_file = bring_to_frame(base_of(scan, o), o.up, scan);
    result.holes = scan.holes;
    result.skin = {scan.surface, cloud.noise_mm};
    Segmentation& s = result.segmentation;
    s.labels = labels_under(scan.surface);
    s.region = find_breast_region(s.labels, o.side);
    s.nipple_in_lps = most_anterior_point(s.labels, s.region);
    s.fractions = s.labels.like<Fractions>({});
    for (std::size_t v = 0; v < s.labels.values.size(); ++v)
      if (label::is_breast(s.labels.values[v])) s.fractions.values[v].fat = 1;
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(path.string() + ": " + error.what());
  }
  return result;
}

}  // namespace mammotwin
