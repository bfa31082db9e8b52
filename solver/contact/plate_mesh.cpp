#include "solver/contact/plate_mesh.h"

#include <tbb/parallel_for.h>
#include <vtkCellArray.h>
#include <vtkImplicitPolyDataDistance.h>
#include <vtkObject.h>
#include <vtkPolyData.h>
#include <vtkSTLReader.h>
#include <vtkSmartPointer.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>

namespace mammotwin {

namespace {

using Eigen::Vector3d;

constexpr int kMostFacets = 1'000'000;
constexpr double kLeastSize = 20, kMostSize = 1000;  // [mm] a compression plate's longest side
constexpr double kMargin = 10;                       // [mm] of the grid around the facets
constexpr double kFinest = 2;                        // [mm]
constexpr double kMostSamples = 200'000;             // 2.5 mm on a plate of 240 x 180 x 40 mm

void check(bool good, const std::filesystem::path& file, const std::string& what) {
  if (!good) throw std::invalid_argument(file.string() + ": " + what);
}

/// The facets that do not face down.
vtkSmartPointer<vtkPolyData> upper_part(vtkPolyData& all) {
  constexpr double down = -0.5;  // of the unit normal's z
  const auto kept = vtkSmartPointer<vtkCellArray>::New();
  for (vtkIdType f = 0; f < all.GetNumberOfCells(); ++f) {
    vtkIdType count;
    const vtkIdType* v;
    all.GetCellPoints(f, count, v);
    const Vector3d a(all.GetPoint(v[0])), b(all.GetPoint(v[1])), c(all.GetPoint(v[2]));
    const Vector3d area = (b - a).cross(c - a);
    if (area.norm() > 0 && area.z() > down * area.norm()) kept->InsertNextCell(count, v);
  }
  const auto part = vtkSmartPointer<vtkPolyData>::New();
  part->SetPoints(all.GetPoints());
  part->SetPolys(kept);
  return part;
}

vtkSmartPointer<vtkPolyData> read_facets(const std::filesystem::path& file) {
  check(std::filesystem::is_regular_file(file), file, "no such file; expected a plate in STL");
  const auto reader = vtkSmartPointer<vtkSTLReader>::New();
  reader->SetFileName(file.c_str());
  const int warnings = vtkObject::GetGlobalWarningDisplay();
  vtkObject::SetGlobalWarningDisplay(0);  // what is wrong with the file is said below
  reader->Update();
  vtkObject::SetGlobalWarningDisplay(warnings);
  const vtkSmartPointer<vtkPolyData> facets = reader->GetOutput();
  const auto count = facets->GetNumberOfPolys();
  check(count > 0, file, "holds no facets; expected a plate in STL");
  check(count <= kMostFacets, file,
        "holds " + std::to_string(count) + " facets; expected at most " +
            std::to_string(kMostFacets));
  return facets;
}

void check_size(const std::filesystem::path& file, const Vector3d& low, const Vector3d& high) {
  const double longest = (high - low).maxCoeff();
  std::ostringstream text;
  text << "reaches over " << longest << " mm; expected " << kLeastSize << " to " << kMostSize
       << " mm (is it in mm?)";
  check(longest >= kLeastSize && longest <= kMostSize, file, text.str());
}

/// Weights of the four cubic B-splines at t in [0, 1], and their derivatives.
struct Weights {
  std::array<double, 4> value, first, second;
  explicit Weights(double t)
      : value{(1 - t) * (1 - t) * (1 - t) / 6, (3 * t * t * t - 6 * t * t + 4) / 6,
              (-3 * t * t * t + 3 * t * t + 3 * t + 1) / 6, t * t * t / 6},
        first{-(1 - t) * (1 - t) / 2, (3 * t * t - 4 * t) / 2, (-3 * t * t + 2 * t + 1) / 2,
              t * t / 2},
        second{1 - t, 3 * t - 2, 1 - 3 * t, t} {}
};

}  // namespace

PlateMesh PlateMesh::read(const std::filesystem::path& file) {
  const auto whole = read_facets(file);
  PlateMesh mesh;
  const double* bounds = whole->GetBounds();
  mesh.low_ = {bounds[0], bounds[2], bounds[4]};
  mesh.high_ = {bounds[1], bounds[3], bounds[5]};
  check(mesh.low_.allFinite() && mesh.high_.allFinite(), file, "holds a number that is not finite");
  check_size(file, mesh.low_, mesh.high_);
  const auto facets = upper_part(*whole);
  check(facets->GetNumberOfPolys() > 0, file,
        "none of its facets faces +z, where the breast is; expected them counter-clockwise seen "
        "from outside");
  const Vector3d extent = mesh.high_ - mesh.low_ + Vector3d::Constant(2 * kMargin);
  mesh.spacing_ = std::max(kFinest, std::cbrt(extent.prod() / kMostSamples));
  mesh.origin_ = mesh.low_ - Vector3d::Constant(kMargin);
  mesh.floor_ = mesh.origin_.z() + 2 * mesh.spacing_;
  for (int i = 0; i < 3; ++i)
    mesh.size_[i] = static_cast<int>(std::ceil(extent[i] / mesh.spacing_)) + 1;

  mesh.sample(*facets);
  mesh.make_coefficients();
  return mesh;
}

void PlateMesh::sample(vtkPolyData& facets) {
  distance_.resize(std::size_t(size_[0]) * size_[1] * size_[2]);
  tbb::parallel_for(0, size_[2], [&](int k) {  // VTK's distance is not for sharing between threads
    const auto distance = vtkSmartPointer<vtkImplicitPolyDataDistance>::New();
    const auto own = vtkSmartPointer<vtkPolyData>::New();
    own->DeepCopy(&facets);
    distance->SetInput(own);
    for (int j = 0; j < size_[1]; ++j)
      for (int i = 0; i < size_[0]; ++i) {
        Vector3d x = origin_ + spacing_ * Vector3d(i, j, k);
        distance_[i + size_[0] * (j + size_[1] * k)] = distance->EvaluateFunction(x.data());
      }
  });
}

void PlateMesh::make_coefficients() {
  int stride = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const std::vector<double> f = distance_;
    for (int n = 0; n < static_cast<int>(f.size()); ++n) {
      const int i = n / stride % size_[axis];
      if (i > 0 && i < size_[axis] - 1)
        distance_[n] -= (f[n - stride] - 2 * f[n] + f[n + stride]) / 6;
    }
    stride *= size_[axis];
  }
}

/// Below the floor: the gap there times 1 + depth / (depth of the floor), which goes on as distance
/// to the face does and keeps the plate's outline.
Gap PlateMesh::gap(const Vector3d& x) const {
  if (x.z() >= floor_) return smoothed(x);
  Gap gap = smoothed({x.x(), x.y(), floor_});
  const double reach = high_.z() - floor_, factor = 1 + (floor_ - x.z()) / reach;
  if (gap.gap >= 0) return gap;
  Eigen::Matrix3d hessian = Eigen::Matrix3d::Zero();
  hessian.topLeftCorner<2, 2>() = factor * gap.hessian.topLeftCorner<2, 2>();
  hessian.block<1, 2>(2, 0) = -gap.normal.head<2>().transpose() / reach;
  hessian.block<2, 1>(0, 2) = -gap.normal.head<2>() / reach;
  const Vector3d gradient(factor * gap.normal.x(), factor * gap.normal.y(), -gap.gap / reach);
  return {factor * gap.gap, gradient, hessian};
}

Gap PlateMesh::smoothed(const Vector3d& x) const {
  const Vector3d u = (x - origin_) / spacing_;
  std::array<int, 3> first;
  for (int d = 0; d < 3; ++d) {
    if (!(u[d] >= 1 && u[d] < size_[d] - 2))
      return {kMargin, Vector3d::UnitZ(), Eigen::Matrix3d::Zero()};
    first[d] = static_cast<int>(u[d]);
  }
  const Weights w[3] = {Weights(u[0] - first[0]), Weights(u[1] - first[1]),
                        Weights(u[2] - first[2])};
  Gap gap{0, Vector3d::Zero(), Eigen::Matrix3d::Zero()};
  for (int k = 0; k < 4; ++k)
    for (int j = 0; j < 4; ++j)
      for (int i = 0; i < 4; ++i) {
        const double c = at(first[0] + i - 1, first[1] + j - 1, first[2] + k - 1);
        const double v[3] = {w[0].value[i], w[1].value[j], w[2].value[k]};
        const double d[3] = {w[0].first[i], w[1].first[j], w[2].first[k]};
        const double dd[3] = {w[0].second[i], w[1].second[j], w[2].second[k]};
        gap.gap += c * v[0] * v[1] * v[2];
        gap.normal += c * Vector3d(d[0] * v[1] * v[2], v[0] * d[1] * v[2], v[0] * v[1] * d[2]);
        gap.hessian.diagonal() +=
            c * Vector3d(dd[0] * v[1] * v[2], v[0] * dd[1] * v[2], v[0] * v[1] * dd[2]);
        gap.hessian(1, 0) += c * d[0] * d[1] * v[2];
        gap.hessian(2, 0) += c * d[0] * v[1] * d[2];
        gap.hessian(2, 1) += c * v[0] * d[1] * d[2];
      }
  gap.normal /= spacing_;
  gap.hessian = (gap.hessian / (spacing_ * spacing_)).selfadjointView<Eigen::Lower>();
  return gap;
}

}  // namespace mammotwin
