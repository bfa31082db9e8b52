#include "fitting/scan/scan_cloud.h"

#include <CGAL/IO/polygon_soup_io.h>
#include <CGAL/IO/read_points.h>
#include <CGAL/Simple_cartesian.h>
#include <CGAL/compute_average_spacing.h>
#include <CGAL/grid_simplify_point_set.h>
#include <CGAL/jet_smooth_point_set.h>
#include <CGAL/remove_outliers.h>

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cstdio>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "fitting/surface/check_surface_file.h"

namespace mammotwin {

namespace {

using Kernel = CGAL::Simple_cartesian<double>;
using Points = std::vector<Kernel::Point_3>;

constexpr std::size_t fewest_points = 1000;
constexpr double smallest_extent_mm = 60, largest_extent_mm = 800;
constexpr double flattest_mm = 2;  // standard deviation off the plane through all points
constexpr int outlier_neighbours = 8;
constexpr double outlier_spacings = 3;
constexpr int jet_neighbours = 24, jet_parameters = 6;  // of a height of degree 2
constexpr double thinned_mm = 1.5;

std::string extension_of(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(), ::tolower);
  return extension;
}

bool is_no_number(std::string word) {
  std::transform(word.begin(), word.end(), word.begin(), ::tolower);
  if (word[0] == '-' || word[0] == '+') word.erase(0, 1);
  return word == "nan" || word == "inf" || word == "infinity" || word.starts_with("nan(") ||
         word.find(".#") != std::string::npos;  // Windows writes 1.#QNAN
}

/// The first line of a text with a NaN or an infinity, at which its readers stop; 0: there is none.
int line_with_no_number(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::string line, word;
  for (int number = 1; std::getline(file, line); ++number)
    for (std::istringstream words(line); words >> word;)
      if (is_no_number(word)) return number;
  return 0;
}

Points read_file(const std::filesystem::path& path) {
  check_surface_file(path);
  Points points;
  const std::string extension = extension_of(path);
  bool read = false;
  if (extension == ".xyz" || extension == ".ply" || extension == ".off") {
    read = CGAL::IO::read_points(path.string(), std::back_inserter(points));
  } else if (extension == ".stl" || extension == ".obj") {
    std::vector<std::vector<std::size_t>> polygons;
    read = CGAL::IO::read_polygon_soup(path.string(), points, polygons);
  }
  if (read) return points;
  if (const int line = line_with_no_number(path))
    throw std::runtime_error(path.string() + ": line " + std::to_string(line) +
                             " has a coordinate that is not a number (NaN or infinite); did the "
                             "scanner mark missing points so? Take them out");
  throw std::runtime_error(path.string() +
                           ": cannot be read as a scan; expected points or a "
                           "surface in PLY, STL, OBJ, OFF or XYZ (x y z a line)");
}

/// Standard deviation along the direction in which the points vary least.
double thickness(const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d mean = Eigen::Vector3d::Zero();
  for (const auto& x : points) mean += x / static_cast<double>(points.size());
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  for (const auto& x : points)
    covariance += (x - mean) * (x - mean).transpose() / static_cast<double>(points.size());
  return std::sqrt(
      std::max(0.0, Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(covariance).eigenvalues()[0]));
}

void require_finite(const std::string& file, const std::vector<Eigen::Vector3d>& points) {
  const auto bad = std::count_if(points.begin(), points.end(),
                                 [](const Eigen::Vector3d& x) { return !x.allFinite(); });
  if (bad)
    throw std::runtime_error(file + ": " + std::to_string(bad) + " of " +
                             std::to_string(points.size()) +
                             " points have coordinates that are not numbers (NaN or infinite); "
                             "did the scanner mark missing points so? Take them out");
}

void drop_duplicates(std::vector<Eigen::Vector3d>& points) {
  const auto before = [](const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
    return std::lexicographical_compare(a.begin(), a.end(), b.begin(), b.end());
  };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
}

void require_breast_size(const std::string& file, const std::vector<Eigen::Vector3d>& points) {
  Eigen::Vector3d low = points[0], high = points[0];
  for (const auto& x : points) low = low.cwiseMin(x), high = high.cwiseMax(x);
  const double extent = (high - low).maxCoeff();
  if (extent >= smallest_extent_mm && extent <= largest_extent_mm) return;
  char text[200];
  std::snprintf(text, sizeof text,
                ": the scan is %.4g mm across; expected %.0f to %.0f mm. Is its unit another "
                "(scan.unit_mm = 1000 for metres, 10 for cm, 0.001 for micrometres)?",
                extent, smallest_extent_mm, largest_extent_mm);
  throw std::runtime_error(file + text);
}

}  // namespace

std::vector<Eigen::Vector3d> read_scan_points(const std::filesystem::path& path, double unit_mm) {
  std::vector<Eigen::Vector3d> points;
  for (const auto& p : read_file(path))
    points.push_back(unit_mm * Eigen::Vector3d(p.x(), p.y(), p.z()));
  require_finite(path.string(), points);
  const std::size_t all = points.size();
  drop_duplicates(points);
  if (points.size() < fewest_points)
    throw std::runtime_error(path.string() + ": " + std::to_string(points.size()) +
                             " distinct points (" + std::to_string(all) +
                             " in all); expected at "
                             "least " +
                             std::to_string(fewest_points) +
                             " on a breast's skin: is the scan complete?");
  require_breast_size(path.string(), points);
  if (thickness(points) < flattest_mm)
    throw std::runtime_error(path.string() + ": all points lie in a plane (within " +
                             std::to_string(static_cast<int>(flattest_mm)) +
                             " mm); is one coordinate missing, or was the table scanned?");
  return points;
}

ScanCloud clean_scan(const std::vector<Eigen::Vector3d>& raw) {
  Points points;
  for (const auto& x : raw) points.emplace_back(x.x(), x.y(), x.z());
  const double spacing =
      CGAL::compute_average_spacing<CGAL::Sequential_tag>(points, outlier_neighbours);
  points.erase(
      CGAL::remove_outliers<CGAL::Sequential_tag>(
          points, outlier_neighbours,
          CGAL::parameters::threshold_percent(100).threshold_distance(outlier_spacings * spacing)),
      points.end());
  ScanCloud cloud;
  cloud.outliers = static_cast<int>(raw.size() - points.size());
  Points smooth = points;
  CGAL::jet_smooth_point_set<CGAL::Sequential_tag>(smooth, jet_neighbours);
  double squares = 0;
  for (std::size_t i = 0; i < points.size(); ++i)
    squares += CGAL::squared_distance(points[i], smooth[i]);
  // A fit of p parameters to n points leaves (n - p) / n of their variance.
  cloud.noise_mm = std::sqrt(squares / static_cast<double>(points.size()) * jet_neighbours /
                             (jet_neighbours - jet_parameters));
  smooth.erase(CGAL::grid_simplify_point_set(smooth, thinned_mm), smooth.end());
  for (const auto& p : smooth) cloud.points.emplace_back(p.x(), p.y(), p.z());
  return cloud;
}

}  // namespace mammotwin
