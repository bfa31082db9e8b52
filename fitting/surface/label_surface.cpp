#include "fitting/surface/label_surface.h"

#include <tbb/parallel_for.h>
#include <vtkCellArray.h>
#include <vtkFlyingEdges3D.h>
#include <vtkIdList.h>
#include <vtkImageData.h>
#include <vtkNew.h>
#include <vtkPointData.h>
#include <vtkPolyData.h>

#include <algorithm>
#include <cmath>

#include "segmentation/image/trilinear.h"

namespace mammotwin {

namespace {

using Mask = Volume<std::uint8_t>;

/// Thickness [mm] that a column without any tissue is given: a region that was pushed out to hold
/// a lesion may have some, and a slab cannot be nothing thick there.
constexpr double empty_column_mm = 5;

/// First and last index along x (axis 0) or z (axis 2) whose plane holds any label.
std::array<int, 2> labelled_range(const Mask& labels, int axis) {
  std::array<int, 2> range = {labels.size[axis], -1};
  for (int k = 0; k < labels.size.z(); ++k)
    for (int j = 0; j < labels.size.y(); ++j)
      for (int i = 0; i < labels.size.x(); ++i) {
        const int at = axis == 0 ? i : k;
        if (labels(i, j, k) == label::air || (at >= range[0] && at <= range[1])) continue;
        range = {std::min(range[0], at), std::max(range[1], at)};
      }
  return range;
}

/// Body (1) and air (0) in a window round the region.
Mask body_in_window(const Mask& labels, const BreastRegion& region, const HeightField& wall,
                    double margin) {
  const auto xs = labelled_range(labels, 0), zs = labelled_range(labels, 2);
  const Eigen::Vector3d low = labels.index({region.x_min - margin, 0, region.z_min - margin});
  const Eigen::Vector3d high = labels.index({region.x_max + margin, 0, region.z_max + margin});
  const int i0 = static_cast<int>(std::floor(low.x())), i1 = static_cast<int>(std::ceil(high.x()));
  const int k0 = static_cast<int>(std::floor(low.z())), k1 = static_cast<int>(std::ceil(high.z()));
  // Planes of air in front let the skin close before the window's end.
  const int front = static_cast<int>(std::ceil(margin / labels.spacing.y()));
  Mask body({i1 - i0 + 1, labels.size.y() + front, k1 - k0 + 1}, labels.spacing,
            labels.position(i0, -front, k0), 0);
  tbb::parallel_for(0, body.size.z(), [&](int k) {
    for (int i = 0; i < body.size.x(); ++i) {
      const Eigen::Vector3d column = body.position(i, 0, k);
      const double wall_y = wall(column.x(), column.z());
      const int from_i = std::clamp(i + i0, xs[0], xs[1]),
                from_k = std::clamp(k + k0, zs[0], zs[1]);
      bool any = false;
      for (int j = 0; j < body.size.y(); ++j) {
        const bool labelled = j >= front && labels(from_i, j - front, from_k) != label::air;
        any = any || labelled;
        body(i, j, k) = labelled || body.position(i, j, k).y() > wall_y;
      }
      for (int j = 0; j < body.size.y() && !any; ++j)
        body(i, j, k) = body.position(i, j, k).y() > wall_y - empty_column_mm;
    }
  });
  return body;
}

/// Voxels within `radius` voxels of one that equals `value` take that value.
Mask grown(const Mask& mask, int radius, std::uint8_t value) {
  Mask result = mask;
  tbb::parallel_for(0, mask.size.z(), [&](int k) {
    for (int dk = -radius; dk <= radius; ++dk)
      for (int dj = -radius; dj <= radius; ++dj)
        for (int di = -radius; di <= radius; ++di) {
          if (di * di + dj * dj + dk * dk > radius * radius) continue;
          if (k + dk < 0 || k + dk >= mask.size.z()) continue;
          const int j0 = std::max(0, -dj), j1 = std::min(mask.size.y(), mask.size.y() - dj);
          const int i0 = std::max(0, -di), i1 = std::min(mask.size.x(), mask.size.x() - di);
          for (int j = j0; j < j1; ++j) {
            const std::uint8_t* from = &mask.values[mask.offset(i0 + di, j + dj, k + dk)];
            std::uint8_t* to = &result.values[mask.offset(i0, j, k)];
            if (value)
              for (int i = 0; i < i1 - i0; ++i) to[i] |= from[i];
            else
              for (int i = 0; i < i1 - i0; ++i) to[i] &= from[i];
          }
        }
  });
  return result;
}

/// 0 in the air that is connected to the front plane, 1 elsewhere.
Mask all_but_front_air(const Mask& body) {
  Mask solid = body.like<std::uint8_t>(1);
  std::vector<std::array<int, 3>> stack;
  const auto visit = [&](int i, int j, int k) {
    if (!body.contains(i, j, k) || body(i, j, k) || !solid(i, j, k)) return;
    solid(i, j, k) = 0;
    stack.push_back({i, j, k});
  };
  for (int k = 0; k < body.size.z(); ++k)
    for (int i = 0; i < body.size.x(); ++i) visit(i, 0, k);
  while (!stack.empty()) {
    const auto [i, j, k] = stack.back();
    stack.pop_back();
    visit(i - 1, j, k), visit(i + 1, j, k), visit(i, j - 1, k);
    visit(i, j + 1, k), visit(i, j, k - 1), visit(i, j, k + 1);
  }
  return solid;
}

/// Gaussian along one axis, the volume's end values going on beyond its ends.
Volume<float> smoothed_along(const Volume<float>& volume, int axis, double sigma) {
  const int radius = static_cast<int>(std::ceil(3.5 * sigma));
  std::vector<float> weights;
  double sum = 0;
  for (int d = -radius; d <= radius; ++d) sum += std::exp(-0.5 * d * d / (sigma * sigma));
  for (int d = -radius; d <= radius; ++d)
    weights.push_back(static_cast<float>(std::exp(-0.5 * d * d / (sigma * sigma)) / sum));
  Volume<float> result = volume.like<float>(0);
  tbb::parallel_for(0, volume.size.z(), [&](int k) {
    for (int j = 0; j < volume.size.y(); ++j)
      for (int d = -radius; d <= radius; ++d) {
        const float w = weights[d + radius];
        float* to = &result.values[volume.offset(0, j, k)];
        if (axis == 0) {
          const float* line = &volume.values[volume.offset(0, j, k)];
          for (int i = 0; i < volume.size.x(); ++i)
            to[i] += w * line[std::clamp(i + d, 0, volume.size.x() - 1)];
        } else {
          const int from_j = axis == 1 ? std::clamp(j + d, 0, volume.size.y() - 1) : j;
          const int from_k = axis == 2 ? std::clamp(k + d, 0, volume.size.z() - 1) : k;
          const float* from = &volume.values[volume.offset(0, from_j, from_k)];
          for (int i = 0; i < volume.size.x(); ++i) to[i] += w * from[i];
        }
      }
  });
  return result;
}

}  // namespace

Volume<float> solid_from_labels(const Volume<std::uint8_t>& labels, const BreastRegion& region,
                                const HeightField& wall, const LabelSurfaceOptions& options) {
  Mask body = body_in_window(labels, region, wall, options.margin_mm);
  if (options.closing_voxels > 0)
    body = grown(grown(body, options.closing_voxels, 1), options.closing_voxels, 0);
  const Mask solid = all_but_front_air(body);
  Volume<float> result = solid.like<float>(0);
  std::copy(solid.values.begin(), solid.values.end(), result.values.begin());
  return result;
}

Volume<float> smoothed(const Volume<float>& volume, double sigma_mm) {
  Volume<float> result = volume;
  for (int axis = 0; axis < 3; ++axis)
    result = smoothed_along(result, axis, sigma_mm / volume.spacing[axis]);
  return result;
}

Volume<float> resampled(const Volume<float>& volume, double spacing_mm) {
  const Eigen::Vector3d extent =
      volume.spacing.cwiseProduct((volume.size - Eigen::Vector3i::Ones()).cast<double>());
  const Eigen::Vector3i size = (extent / spacing_mm).array().floor().cast<int>() + 1;
  const Eigen::Vector3d left_over =
      extent - spacing_mm * (size - Eigen::Vector3i::Ones()).cast<double>();
  Volume<float> result(size, Eigen::Vector3d::Constant(spacing_mm), volume.origin + left_over / 2);
  const Eigen::Vector3d last = (volume.size - Eigen::Vector3i::Ones()).cast<double>();
  tbb::parallel_for(0, size.z(), [&](int k) {
    for (int j = 0; j < size.y(); ++j)
      for (int i = 0; i < size.x(); ++i)
        result(i, j, k) = static_cast<float>(
            trilinear_corners(volume,
                              volume.index(result.position(i, j, k)).cwiseMax(0).cwiseMin(last))
                .of(volume));
  });
  return result;
}

TriangleSurface solid_boundary(const Volume<float>& volume) {
  // A node that lies on the boundary would be the corner of triangles without area: it is put
  // 0.4 um off (where the field falls by 1/2 over 2 mm).
  constexpr float kOn = 0.5F, kNear = 1e-6F, kOff = 1e-4F;
  const auto off_the_boundary = [](float value) {
    return std::abs(value - kOn) > kNear ? value : value < kOn ? kOn - kOff : kOn + kOff;
  };
  vtkNew<vtkImageData> image;
  image->SetDimensions(volume.size.x(), volume.size.y(), volume.size.z());
  image->SetSpacing(volume.spacing.x(), volume.spacing.y(), volume.spacing.z());
  image->SetOrigin(volume.origin.x(), volume.origin.y(), volume.origin.z());
  image->AllocateScalars(VTK_FLOAT, 1);
  std::transform(volume.values.begin(), volume.values.end(),
                 static_cast<float*>(image->GetScalarPointer()), off_the_boundary);
  vtkNew<vtkFlyingEdges3D> contour;
  contour->SetInputData(image);
  contour->SetValue(0, kOn);
  contour->ComputeNormalsOff();
  contour->ComputeScalarsOff();
  contour->Update();
  vtkPolyData* poly = contour->GetOutput();
  TriangleSurface surface;
  for (vtkIdType p = 0; p < poly->GetNumberOfPoints(); ++p)
    surface.vertices.emplace_back(poly->GetPoint(p));
  vtkNew<vtkIdList> ids;
  for (vtkIdType t = 0; t < poly->GetNumberOfPolys(); ++t) {
    poly->GetPolys()->GetCellAtId(t, ids);
    surface.triangles.push_back({static_cast<int>(ids->GetId(0)), static_cast<int>(ids->GetId(1)),
                                 static_cast<int>(ids->GetId(2))});
  }
  return surface;
}

TriangleSurface cropped(const TriangleSurface& surface, const BreastRegion& region, double snap) {
  TriangleSurface part = clip(surface, 0, region.x_min, true, snap);
  part = clip(part, 0, region.x_max, false, snap);
  part = clip(part, 2, region.z_min, true, snap);
  return largest_part(clip(part, 2, region.z_max, false, snap));
}

}  // namespace mammotwin
