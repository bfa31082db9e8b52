#include "fitting/fit_breast.h"

#include "fitting/fit_quality.h"
#include "fitting/fit_samples.h"
#include "fitting/mesh/jacobian_bound.h"
#include "fitting/newton_step.h"
#include "fitting/skin_to_fit.h"

#include <algorithm>
#include <optional>
#include <stdexcept>

namespace mammotwin {

namespace {

// Elements below these get emphasis.
constexpr double wanted_scaled_jacobian = 0.15;
constexpr double wanted_determinant = 0.03;  // of the mean
constexpr int smallest_breast_voxels = 20000;  // 20 ml at 1 mm

void check(const FitOptions& o) {
  const auto require = [](bool good, const std::string& message) {
    if (!good) throw std::invalid_argument("fit: " + message);
  };
  require(o.elements.minCoeff() >= 1 && o.elements.maxCoeff() <= 16,
          "elements must be 1 to 16 in each direction");
  require(o.smoothing >= 1e-12 && o.smoothing <= 1e-3, "smoothing must be 1e-12 to 1e-3");
  require(o.shape >= 0.1 && o.shape <= 10, "shape must be 0.1 to 10");
}

void require_breast(const Segmentation& s) {
  long voxels = 0;
  for (int k = 0; k < s.labels.size.z(); ++k)
    for (int j = 0; j < s.labels.size.y(); ++j)
      for (int i = 0; i < s.labels.size.x(); ++i)
        voxels += label::is_breast(s.labels(i, j, k)) && s.region.contains(s.labels.position(i, j, k));
  if (voxels < smallest_breast_voxels)
    throw std::runtime_error("fit: the breast's region holds " + std::to_string(voxels) +
                             " voxels of tissue; expected at least " +
                             std::to_string(smallest_breast_voxels) +
                             " (is it the right side, and does the segmentation show a breast?)");
}

/// Weights of one part of the fit.
struct Stage {
  double data, mu, sobolev;
  int steps;
};

/// The fit as it goes.
class Fit {
 public:
  Fit(const Slab& slab, HermiteMesh start, FitTarget& target, FitReport& report,
      const FitProgress& progress)
      : slab_(slab), start_(std::move(start)), nodes_(start_.nodes()),
        emphasis_(start_.num_elements(), 0), target_(target),
        newton_(start_.elements(), held_parameters(slab)), report_(report), progress_(progress) {}

  HermiteMesh mesh() const { return HermiteMesh(nodes_, start_.elements()); }

  void restart() {
    nodes_ = start_.nodes();
    emphasis_.assign(emphasis_.size(), 0);
    target_.forget_feet();
  }

  /// Newton steps, closest points renewed before each, until they gain little.
  void run(const Stage& stage, bool must_stay_proved) {
    FitModel model(slab_, start_, stage.mu, stage.sobolev, emphasis_);
    for (int step = 0; step < stage.steps; ++step) {
      model.update(nodes_, target_.samples(mesh(), {stage.data}));
      report_.skin_rms_by_iteration_mm.push_back(target_.skin_rms());
      const StepReport done = newton_.step(model, must_stay_proved, nodes_);
      ++report_.iterations;
      if (progress_)
        progress_(std::min(0.9, 0.2 + 0.03 * report_.iterations), "fitting the mesh");
      if (done.cost_before - done.cost_after < smallest_gain * done.cost_before) break;
    }
  }

  /// Gives more weight to elements that are badly shaped or near folding; false if there are none.
  bool emphasise_poor() {
    const std::vector<JacobianBound> bounds = bound_elements(mesh());
    const std::vector<double> scaled = scaled_jacobians(mesh());
    bool any = false;
    for (std::size_t e = 0; e < scaled.size(); ++e)
      if (bounds[e].lower < wanted_determinant || scaled[e] < wanted_scaled_jacobian)
        ++emphasis_[e], any = true;
    return any;
  }

 private:
  static constexpr double smallest_gain = 3e-4;  // of the cost, of which about 1 is energy that no fit can lose

  Slab slab_;
  HermiteMesh start_;
  std::vector<HermiteMesh::Node> nodes_;
  std::vector<int> emphasis_;
  FitTarget& target_;
  NewtonStep newton_;
  FitReport& report_;
  const FitProgress& progress_;
};

/// From the start to a mesh that is proved valid. Where the data folds it, the data waits.
bool untangle(Fit& fit) {
  constexpr double mu = 10;
  fit.run({1, mu, 1e-6, 6}, false);
  if (proved_valid(fit.mesh())) return true;
  for (double sobolev : {1e-6, 1e-5, 1e-4}) {
    fit.restart();
    fit.run({0.02, mu, sobolev, 8}, false);
    if (!proved_valid(fit.mesh())) continue;
    fit.run({0.1, mu, 1e-6, 4}, true);
    fit.emphasise_poor();
    fit.run({1, mu, 1e-6, 4}, true);
    return true;
  }
  return false;
}

/// Valid nodes by the recipe of fitting/README.md; empty if none were found.
std::optional<HermiteMesh> fit_slab(const Slab& slab, const HermiteMesh& start, FitTarget& target,
                                    const FitOptions& o, FitReport& report,
                                    const FitProgress& progress) {
  Fit fit(slab, start, target, report, progress);
  if (!untangle(fit)) return std::nullopt;
  fit.emphasise_poor();
  fit.run({1, o.shape, o.smoothing, 5}, true);
  for (int round = 0; round < 3 && fit.emphasise_poor(); ++round)
    fit.run({1, o.shape, o.smoothing, 3}, true);
  return fit.mesh();
}

void judge(FitReport& r) {
  const auto look = [&](bool bad, const std::string& reason) {
    if (bad) r.reasons.push_back(reason);
  };
  look(std::max(r.skin_rms_mesh_to_data_mm, r.skin_rms_data_to_mesh_mm) > 1,
       "The mesh's skin is more than 1 mm (RMS) off the labels'.");
  look(r.covered_fraction < 0.97, "Less than 97 % of the breast's voxels lie in the mesh.");
  look(r.covered_lesions < 0.99, "Part of a lesion lies outside the mesh.");
  look(r.chest_wall_rms_mm > 2, "The mesh's chest wall is more than 2 mm (RMS) off the muscle.");
  r.status = r.reasons.empty() ? "ok" : "look";
}

void measure(MeshFile& file, const Segmentation& s, const BreastRegion& region,
             const ChestWall& wall, FitReport& r) {
  const TriangleSurface labelled = skin_as_labelled(s, region, wall);
  const SurfaceDistances skin =
      surface_distances(file.mesh, file.faces, FaceLabel::skin, labelled);
  file.fields["skin_distance_mm"] = skin_distance_field(file, labelled);
  r.skin_rms_mesh_to_data_mm = skin.rms_mesh_to_data;
  r.skin_rms_data_to_mesh_mm = skin.rms_data_to_mesh;
  r.skin_p95_mm = skin.p95;
  r.skin_max_mm = skin.max;
  r.farthest_in_lps = skin.farthest;
  r.chest_wall_rms_mm = rms_to_faces(file.mesh, file.faces, FaceLabel::chest_wall, wall.labelled);
  r.min_jacobian_bound = bound_jacobian(file.mesh).lower;
  const std::vector<double> scaled = scaled_jacobians(file.mesh);
  r.min_scaled_jacobian = *std::min_element(scaled.begin(), scaled.end());
  const Coverage covered = coverage(file.mesh, s.labels, s.region);
  r.covered_fraction = covered.breast;
  r.covered_lesions = covered.lesions;
  judge(r);
}

}  // namespace

FitResult fit_breast(const Segmentation& s, const FitOptions& options,
                     const FitProgress& progress) {
  check(options);
  require_breast(s);
  const auto tell = [&](double fraction, const char* what) {
    if (progress) progress(fraction, what);
  };
  tell(0, "finding skin and chest wall");
  const ChestWall wall = find_chest_wall(s.labels, s.region);
  const SkinToFit skin = find_skin_to_fit(s, wall);
  tell(0.1, "flattening the skin");
  const FlatSkin flat = flatten(skin.surface, skin.region);
  const Slab slab{options.elements};
  const HermiteMesh start = straight_start(slab, skin.surface, flat, wall.height, skin.region);

  FitResult result{{HermiteMesh({}, {}), {}, {}, {}, {}, {}}, {}};
  result.report.elements = options.elements;
  FitTarget target(slab, skin.surface, flat, wall.height);
  if (!skin.doubt.empty()) result.report.reasons.push_back(skin.doubt);
  const auto mesh = fit_slab(slab, start, target, options, result.report, progress);
  if (!mesh) {
    result.report.status = "not_converged";
    result.report.reasons.push_back("No mesh was found whose elements are all valid; look at the "
                             "segmentation's skin and chest wall, or try other element counts.");
    return result;
  }
  result.mesh.mesh = *mesh;
  result.mesh.faces = slab_faces(slab);
  tell(0.9, "measuring the fit");
  measure(result.mesh, s, skin.region, wall, result.report);
  tell(1, "done");
  return result;
}

}  // namespace mammotwin
