#include "fitting/fit_breast.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "fitting/fit_limits.h"
#include "fitting/fit_quality.h"
#include "fitting/mesh/jacobian_bound.h"
#include "fitting/mirror.h"
#include "fitting/solve/fit_mesh.h"
#include "fitting/surface/skin_to_fit.h"
#include "segmentation/mirrored.h"

namespace mammotwin {

namespace {

constexpr int smallest_breast_voxels = 20000;  // 20 ml at 1 mm
// Columns along x and z that are tried in turn for an accuracy.
constexpr std::array<int, 7> column_counts = {4, 5, 6, 7, 8, 10, 12};
// By what tissue pressed with 16 x 16 x 3 elements does (docs/measured/refinement.md). Areas are of
// a skin smoothed by 1 mm.
constexpr double largest_column_mm2 = 600;
constexpr int more_columns = 2;  // where a skin is too uneven for as many as its area asks for
constexpr double worth_pulling_in_mm = 1;  // RMS of the skin, beyond which an edge is given up
constexpr int fewest_columns = 9, most_columns = 12, layers = 2;

void check(const FitOptions& o) {
  const auto require = [](bool good, const std::string& message) {
    if (!good) throw std::invalid_argument("fit: " + message);
  };
  require(!o.elements || (o.elements->minCoeff() >= 1 && o.elements->maxCoeff() <= 16),
          "elements must be 1 to 16 in each direction");
  require(!o.accuracy_mm || (*o.accuracy_mm >= 0.05 && *o.accuracy_mm <= 5),
          "accuracy must be 0.05 to 5 mm");
  require(!o.smoothing || (*o.smoothing >= 1e-12 && *o.smoothing <= 1e-3),
          "smoothing must be 1e-12 to 1e-3");
  require(o.max_iterations >= 1 && o.max_iterations <= 10000, "max_iterations must be 1 to 10000");
  require(o.shape >= 0.1 && o.shape <= 10, "shape must be 0.1 to 10");
}

/// A variance of the data against curvature of the mesh: proportional to the square of the noise.
double smoothing_for(double noise_mm) {
  // 1e-8 at 0.29 mm, the noise of labels of 1 mm, was found on 20 breasts.
  constexpr double known = 1e-8, its_noise_mm = 0.29;
  const double ratio = noise_mm / its_noise_mm;
  return std::clamp(known * ratio * ratio, 1e-10, 1e-6);
}

/// A surface rounded to voxels is uniformly wrong by up to half of one.
double noise_of_labels(const Segmentation& s) { return s.labels.spacing.mean() / std::sqrt(12.0); }

void require_breast(const Segmentation& s) {
  long voxels = 0;
  for (int k = 0; k < s.labels.size.z(); ++k)
    for (int j = 0; j < s.labels.size.y(); ++j)
      for (int i = 0; i < s.labels.size.x(); ++i)
        voxels +=
            label::is_breast(s.labels(i, j, k)) && s.region.contains(s.labels.position(i, j, k));
  if (voxels < smallest_breast_voxels)
    throw std::runtime_error("fit: the breast's region holds " + std::to_string(voxels) +
                             " voxels of tissue; expected at least " +
                             std::to_string(smallest_breast_voxels) +
                             " (is it the right side, and does the segmentation show a breast?)");
}

void judge(FitReport& r) {
  const auto look = [&](bool bad, const std::string& reason) {
    if (bad) r.reasons.push_back(reason);
  };
  look(std::max(r.skin_rms_mesh_to_data_mm, r.skin_rms_data_to_mesh_mm) > limits::skin_rms_mm,
       "The mesh's skin is more than 0.5 mm (RMS) off the labels'.");
  look(r.skin_p95_mm > limits::skin_p95_mm,
       "More than 5 % of the skin is more than 0.8 mm off the labels'.");
  look(r.covered_fraction < limits::covered_breast,
       "Less than 97 % of the breast's voxels lie in the mesh.");
  look(r.covered_lesions < limits::covered_lesions, "Part of a lesion lies outside the mesh.");
  look(r.chest_wall_rms_mm > limits::chest_wall_rms_mm,
       "The mesh's chest wall is more than 2 mm (RMS) off the muscle.");
  r.status = r.reasons.empty() ? "ok" : "look";
}

void measure(MeshFile& file, const Segmentation& s, const TriangleSurface& data,
             const MuscleFront& wall, FitReport& r) {
  const SurfaceDistances skin =
      surface_distances(file.mesh, file.faces, FaceLabel::skin, data, s.nipple_in_lps);
  file.fields["skin_distance_mm"] = skin_distance_field(file, data);
  r.skin_rms_mesh_to_data_mm = skin.rms_mesh_to_data;
  r.skin_rms_data_to_mesh_mm = skin.rms_data_to_mesh;
  r.skin_p95_mm = skin.p95;
  r.skin_max_mm = skin.max;
  r.farthest_in_lps = skin.farthest;
  r.nipple_error_mm = skin.max_at_landmark;
  r.chest_wall_rms_mm = rms_to_faces(file.mesh, file.faces, FaceLabel::chest_wall, wall.labelled);
  r.min_jacobian_bound = bound_jacobian(file.mesh).lower;
  const std::vector<double> scaled = scaled_jacobians(file.mesh);
  r.min_scaled_jacobian = *std::min_element(scaled.begin(), scaled.end());
  const Coverage covered = coverage(file.mesh, s.labels, s.region);
  r.covered_fraction = covered.breast;
  r.covered_lesions = covered.lesions;
  judge(r);
}

double area_mm2(const TriangleSurface& surface) {
  const std::vector<double> areas = surface.vertex_areas();
  return std::accumulate(areas.begin(), areas.end(), 0.0);
}

/// One breast and what its fits share.
class BreastFit {
 public:
  BreastFit(const Segmentation& s, const FitOptions& options, const FitProgress& progress,
            const ScannedSkin* scan)
      : s_(s),
        options_(options),
        progress_(progress),
        scan_(scan),
        wall_(find_muscle_front(s.labels, s.region)),
        skin_(scan ? scanned_skin_to_fit(scan->surface, s.region) : find_skin_to_fit(s, wall_)),
        noise_mm_(scan ? scan->noise_mm : noise_of_labels(s)) {}

  /// As asked, else as many columns as the skin is large.
  Eigen::Vector3i elements() const {
    return options_.elements.value_or(elements_for(area_mm2(skin_.surface)));
  }

  /// Where the fit goes wrong at the region's edge, that edge is pulled in, twice at most.
  FitResult with(const Eigen::Vector3i& elements) const {
    FitResult best = once(elements, skin_);
    SkinToFit skin = skin_;
    for (double by : {6.0, 12.0}) {
      if (good(best.report)) break;
      skin = without_edges_near(best.report.farthest_in_lps, by, skin_, s_.lesions);
      if (skin.surface.triangles.empty()) break;
      FitResult next = once(elements, skin);
      if (error(next.report) < error(best.report)) best = std::move(next);
    }
    return best;
  }

  /// As many columns as the skin is large, and more where it asks for them. The nearest is kept.
  FitResult of_its_size() const {
    Eigen::Vector3i columns = elements();
    FitResult best = with(columns);
    for (int more = 1; more <= more_columns && columns.x() < most_columns; ++more) {
      if (near_enough(best.report)) break;
      columns.head<2>().array() += 1;
      FitResult next = with(columns);
      if (error(next.report) < error(best.report)) best = std::move(next);
    }
    return best;
  }

  /// The coarsest mesh that is as near to the data as asked, else the finest.
  FitResult to_accuracy(double accuracy_mm) const {
    FitResult result{{HermiteMesh({}, {}), {}, {}, {}, {}, {}}, {}};
    for (int columns : column_counts) {
      result = with({columns, columns, elements().z()});
      if (result.report.usable() && error(result.report) <= accuracy_mm) return result;
    }
    if (result.report.usable()) {
      result.report.status = "look";
      result.report.reasons.push_back("The accuracy that was asked for is not reached.");
    }
    return result;
  }

 private:
  static double error(const FitReport& r) {
    if (!r.usable()) return std::numeric_limits<double>::infinity();
    return std::max(r.skin_rms_mesh_to_data_mm, r.skin_rms_data_to_mesh_mm);
  }
  static bool near_enough(const FitReport& r) {
    return error(r) <= limits::skin_rms_mm && r.skin_p95_mm <= limits::skin_p95_mm;
  }
  static bool good(const FitReport& r) { return error(r) < worth_pulling_in_mm; }

  FitResult once(const Eigen::Vector3i& elements, const SkinToFit& skin) const {
    tell(0.1, "flattening the skin");
    const FlatSkin flat = flatten(skin.surface, skin.region);
    const FitGoal goal{skin.surface, flat, wall_.height, skin.region, s_.nipple_in_lps};
    const Slab slab = slab_around_nipple(elements, goal);
    FitResult result{{HermiteMesh({}, {}), {}, {}, {}, {}, {}}, {}};
    FitReport& report = result.report;
    report.elements = elements;
    report.noise_mm = noise_mm_;
    report.smoothing = options_.smoothing.value_or(smoothing_for(noise_mm_));
    const FittedMesh fitted = fit_mesh(slab, goal, options_, report, progress_);
    if (report.iterations >= options_.max_iterations)
      report.reasons.push_back("The fit ended after " + std::to_string(report.iterations) +
                               " iterations (fit.max_iterations), before it was done.");
    if (!skin.doubt.empty()) report.reasons.push_back(skin.doubt);
    if (!fitted.valid) {
      report.status = "not_converged";
      report.reasons.push_back(
          "No mesh was found whose elements are all valid; look at the "
          "segmentation's skin and chest wall, or try other element counts.");
      report.farthest_in_lps = most_folded(fitted.mesh);
      return result;
    }
    result.mesh.mesh = fitted.mesh;
    result.mesh.faces = slab_faces(slab);
    tell(0.9, "measuring the fit");
    measure(result.mesh, s_, data(skin.region), wall_, report);
    return result;
  }

  /// The skin that distances go to: neither closed nor smoothed.
  TriangleSurface data(const BreastRegion& region) const {
    return scan_ ? scanned_skin_to_fit(scan_->surface, region).surface
                 : skin_as_labelled(s_, region, wall_);
  }

  static Eigen::Vector3d most_folded(const HermiteMesh& mesh) {
    const std::vector<double> scaled = scaled_jacobians(mesh);
    const auto at = std::min_element(scaled.begin(), scaled.end()) - scaled.begin();
    return mesh.position({static_cast<int>(at), {0.5, 0.5, 1}});
  }

  void tell(double fraction, const char* what) const {
    if (progress_) progress_(fraction, what);
  }

  const Segmentation& s_;
  const FitOptions& options_;
  const FitProgress& progress_;
  const ScannedSkin* scan_;
  MuscleFront wall_;
  SkinToFit skin_;
  double noise_mm_;
};

/// Progress that never goes back, though several meshes may be tried.
FitProgress growing(const FitProgress& progress) {
  if (!progress) return {};
  return [&progress, last = 0.0](double fraction, const std::string& what) mutable {
    last = std::max(last, fraction);
    progress(last, what);
  };
}

FitResult fit_left(const Segmentation& s, const FitOptions& options, const FitProgress& progress,
                   const ScannedSkin* scan) {
  const BreastFit fit(s, options, progress, scan);
  return options.accuracy_mm ? fit.to_accuracy(*options.accuracy_mm)
         : options.elements  ? fit.with(*options.elements)
                             : fit.of_its_size();
}

/// As the left breast that it mirrors: the same breast gets the same mesh.
FitResult fit_right(const Segmentation& s, const FitOptions& options, const FitProgress& progress,
                    const ScannedSkin* scan) {
  if (!scan) return mirrored(fit_left(mirrored(s), options, progress, nullptr));
  const ScannedSkin as_left = mirrored(*scan);
  return mirrored(fit_left(mirrored(s), options, progress, &as_left));
}

}  // namespace

Eigen::Vector3i elements_for(double skin_area_mm2) {
  const int needed = static_cast<int>(std::ceil(std::sqrt(skin_area_mm2 / largest_column_mm2)));
  const int columns = std::clamp(needed, fewest_columns, most_columns);
  return {columns, columns, layers};
}

FitResult fit_breast(const Segmentation& s, const FitOptions& options, const FitProgress& progress,
                     const ScannedSkin* scan) {
  check(options);
  require_breast(s);
  const FitProgress tell = growing(progress);
  if (tell) tell(0, "finding skin and chest wall");
  FitResult result = s.region.side == Side::left ? fit_left(s, options, tell, scan)
                                                 : fit_right(s, options, tell, scan);
  if (tell) tell(1, "done");
  return result;
}

}  // namespace mammotwin
