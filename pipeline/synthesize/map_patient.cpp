#include "pipeline/synthesize/map_patient.h"

#include <cmath>
#include <limits>

#include "pipeline/synthesize/coil.h"
#include "pipeline/synthesize/true_region.h"

namespace mammotwin {
namespace {

using Eigen::Vector3d;

/// Numbers the lesions of one side from 1 and those of the other side after them.
int number_side_first(MapBody& body, Side side) {
  struct Place {
    double x = 0, voxels = 0;
  };
  std::vector<Place> places(256);
  for (int k = 0; k < body.lesion.size.z(); ++k)
    for (int j = 0; j < body.lesion.size.y(); ++j)
      for (int i = 0; i < body.lesion.size.x(); ++i)
        if (const std::uint8_t n = body.lesion(i, j, k); n > 0)
          places[n].x += body.substance.position(i, j, k).x(), ++places[n].voxels;
  std::vector<std::uint8_t> renumbered(256, 0);
  std::uint8_t next = 1;
  int on_side = 0;
  for (const bool wanted : {true, false})
    for (int n = 1; n < 256; ++n) {
      if (places[n].voxels == 0) continue;
      if (((places[n].x > 0) == (side == Side::left)) != wanted) continue;
      renumbered[n] = next++;
      on_side += wanted;
    }
  for (std::uint8_t& n : body.lesion.values) n = renumbered[n];
  return on_side;
}

/// Loops beside, above and below one breast.
void add_loops(const ColumnMap& columns, Side side, std::vector<Vector3d>& loops,
               Vector3d& reference) {
  constexpr double gap_mm = 10, share = 0.55;  // of the way from the apex to the muscle
  const BreastRegion r = true_region(columns, side, {});
  double front = 1e9, thickness = 0;
  for (int k = 0; k < columns.nz; ++k)
    for (int i = 0; i < columns.nx; ++i)
      if (r.contains({columns.x(i), 0, columns.z(k)}) && columns.at(columns.front, i, k) < front)
        front = columns.at(columns.front, i, k), thickness = columns.at(columns.thickness, i, k);
  const Vector3d middle((r.x_min + r.x_max) / 2, front + share * thickness,
                        (r.z_min + r.z_max) / 2);
  const Vector3d across((r.x_max - r.x_min) / 2 + gap_mm, 0, 0);
  const Vector3d along(0, 0, (r.z_max - r.z_min) / 2 + gap_mm);
  for (const Vector3d& offset : {across, along}) {
    loops.push_back(middle + offset);
    loops.push_back(middle - offset);
  }
  reference = middle;
}

Coil coil_of(const ColumnMap& columns, Side side, double radius_mm) {
  std::vector<Vector3d> loops;
  Vector3d left, right;
  add_loops(columns, Side::left, loops, left);
  add_loops(columns, Side::right, loops, right);
  return Coil(std::move(loops), radius_mm, side == Side::left ? left : right);
}

/// Nothing says where the breast ends in a column without muscle: the truth ends with the map.
void end_flanks(double last_y, Volume<std::uint8_t>& labels) {
  const int last = static_cast<int>((last_y - labels.origin.y()) / labels.spacing.y());
  for (int k = 0; k < labels.size.z(); ++k)
    for (int i = 0; i < labels.size.x(); ++i) {
      bool muscle = false;
      for (int j = 0; j < labels.size.y(); ++j) muscle = muscle || labels(i, j, k) == label::muscle;
      for (int j = last + 1; !muscle && j < labels.size.y(); ++j) labels(i, j, k) = label::air;
    }
}

}  // namespace

SyntheticPatient make_map_patient(const MapBody& whole, Side side, const ScanOptions& options,
                                  std::uint64_t seed) {
  MapBody body = whole;
  const int lesions = number_side_first(body, side);
  SyntheticPatient p;
  p.options.anatomy.side = side;
  p.options.anatomy.seed = seed;
  p.options.scan = options;
  p.tissue = body.sample(options.voxel_mm, options.samples);
  p.labels = label_map(p.tissue);
  end_flanks(body.last_y, p.labels);
  p.truth = measure_truth(p.tissue, p.labels, side, lesions);
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  p.truth.nipple_in_lps.setConstant(unknown);
  p.truth.skin_thickness_mm = unknown;
  const ColumnMap columns = columns_of(p.labels);
  const Coil coil = coil_of(columns, side, coil_radius_mm(options.contrast));
  const BreastRegion& r = p.truth.region;
  const Vector3d patch((r.x_min + r.x_max) / 2, 0, (r.z_min + r.z_max) / 2 + 20);
  p.scan = scan(p.tissue, coil, options, seed, patch);
  p.truth.shading_ratio = p.scan.shading_ratio;
  return p;
}

}  // namespace mammotwin
