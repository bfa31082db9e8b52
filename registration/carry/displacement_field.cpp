#include "registration/carry/displacement_field.h"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "registration/carry/point_carrier.h"
#include "registration/carry/position_grid.h"
#include "segmentation/files/write_image_file.h"
#include "segmentation/image/trilinear.h"

namespace mammotwin {
namespace {

constexpr int kContinued = 2;  // voxels beyond the surface: interpolation reaches one

enum Place : std::uint8_t { unknown, inside, continued };

bool touches(const Volume<std::uint8_t>& state, int i, int j, int k) {
  for (int c = -1; c <= 1; ++c)
    for (int b = -1; b <= 1; ++b)
      for (int a = -1; a <= 1; ++a)
        if (state.contains(i + a, j + b, k + c) && state(i + a, j + b, k + c) != unknown)
          return true;
  return false;
}

/// One layer of voxels round what is known, carried with the nearest tissue.
void continue_one_layer(const PointCarrier& carrier, Volume<std::uint8_t>& state,
                        DisplacementField& field) {
  const Volume<std::uint8_t> before = state;
  tbb::parallel_for(0, state.size.z(), [&](int k) {
    for (int j = 0; j < state.size.y(); ++j)
      for (int i = 0; i < state.size.x(); ++i) {
        if (before(i, j, k) != unknown || !touches(before, i, j, k)) continue;
        const Eigen::Vector3d x = field.position(i, j, k);
        field(i, j, k) = (carrier.carry(x).in_lps - x).cast<float>();
        state(i, j, k) = continued;
      }
  });
}

Eigen::Vector3d interpolate(const DisplacementField& field, const TrilinearCorners& corners) {
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  for (int c = 0; c < corners.count; ++c)
    sum += corners.weights[c] * field.values[corners.voxels[c]].cast<double>();
  return sum;
}

/// A voxel centre of a field inside its mesh, and where the field takes it.
struct Composed {
  Eigen::Vector3d x, y;
};
std::vector<Composed> composed(const DisplacementField& there, const HermiteMesh& mesh) {
  PositionGrid inside_of = there.like<Eigen::Vector3d>(Eigen::Vector3d::Zero());
  fill_positions(mesh, mesh, inside_of);
  std::vector<Composed> points;
  for (int k = 0; k < there.size.z(); ++k)
    for (int j = 0; j < there.size.y(); ++j)
      for (int i = 0; i < there.size.x(); ++i) {
        if (!inside_of(i, j, k).allFinite()) continue;
        const Eigen::Vector3d x = there.position(i, j, k);
        points.push_back({x, x + there(i, j, k).cast<double>()});
      }
  return points;
}

CompositionError error_of(const std::vector<Composed>& points, const DisplacementField& back) {
  std::vector<double> errors;
  for (const Composed& p : points)
    errors.push_back((p.y + displacement_at(back, p.y) - p.x).norm());
  if (errors.empty()) return {};
  std::sort(errors.begin(), errors.end());
  double sum = 0;
  for (const double e : errors) sum += e;
  return {sum / errors.size(), errors[static_cast<std::size_t>(0.99 * (errors.size() - 1))],
          errors.back(), errors.size()};
}

}  // namespace

DisplacementField displacement_field(const HermiteMesh& here, const HermiteMesh& target,
                                     double spacing_mm) {
  Eigen::AlignedBox3d box = bounding_box(here);
  const Eigen::Vector3d rim = Eigen::Vector3d::Constant(kContinued * spacing_mm);
  PositionGrid positions =
      cover(Eigen::AlignedBox3d((box.min() - rim).eval(), (box.max() + rim).eval()), spacing_mm);
  fill_positions(here, target, positions);

  DisplacementField field = positions.like<Eigen::Vector3f>(Eigen::Vector3f::Zero());
  Volume<std::uint8_t> state = positions.like<std::uint8_t>(unknown);
  for (int k = 0; k < field.size.z(); ++k)
    for (int j = 0; j < field.size.y(); ++j)
      for (int i = 0; i < field.size.x(); ++i) {
        if (!positions(i, j, k).allFinite()) continue;
        state(i, j, k) = inside;
        field(i, j, k) = (positions(i, j, k) - field.position(i, j, k)).cast<float>();
      }
  const PointCarrier carrier(here, target);
  for (int layer = 0; layer < kContinued; ++layer) continue_one_layer(carrier, state, field);
  return field;
}

Eigen::Vector3d displacement_at(const DisplacementField& field, const Eigen::Vector3d& x) {
  return interpolate(field, trilinear_corners(field, field.index(x)));
}

CompositionError compose_to_identity(const DisplacementField& there, const HermiteMesh& there_mesh,
                                     double tolerance_mm, DisplacementField& back) {
  constexpr int most_rounds = 60;
  const std::vector<Composed> points = composed(there, there_mesh);
  std::vector<TrilinearCorners> corners(points.size());  // the same in every round
  tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t p) {
    corners[p] = trilinear_corners(back, back.index(points[p].y));
  });
  std::vector<Eigen::Vector3d> misses(points.size());
  std::vector<Eigen::Vector4d> left(back.values.size());
  for (int round = 0; round < most_rounds; ++round) {
    tbb::parallel_for(std::size_t{0}, points.size(), [&](std::size_t p) {
      misses[p] = points[p].y + interpolate(back, corners[p]) - points[p].x;
    });
    std::fill(left.begin(), left.end(), Eigen::Vector4d::Zero());
    double worst = 0;
    for (std::size_t p = 0; p < points.size(); ++p) {
      const Eigen::Vector4d miss(misses[p].x(), misses[p].y(), misses[p].z(), 1);
      worst = std::max(worst, misses[p].norm());
      for (int c = 0; c < corners[p].count; ++c)
        left[corners[p].voxels[c]] += corners[p].weights[c] * miss;
    }
    if (worst <= tolerance_mm) break;
    for (std::size_t v = 0; v < left.size(); ++v)
      if (left[v].w() > 0) back.values[v] -= (left[v].head<3>() / left[v].w()).cast<float>();
  }
  return error_of(points, back);
}

CompositionError composition_error(const DisplacementField& there, const DisplacementField& back,
                                   const HermiteMesh& there_mesh) {
  return error_of(composed(there, there_mesh), back);
}

void write_displacement_field(const std::filesystem::path& path, const DisplacementField& field) {
  FileGrid grid;
  for (int a = 0; a < 3; ++a) {
    grid.size[a] = field.size[a];
    grid.spacing[a] = field.spacing[a];
    grid.origin[a] = field.origin[a];
  }
  write_nrrd(path, grid, field.values.front().data(), 3, {});
}

}  // namespace mammotwin
