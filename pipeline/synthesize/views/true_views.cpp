#include "pipeline/synthesize/views/true_views.h"

#include <cmath>
#include <stdexcept>

#include "fitting/fit_breast.h"
#include "fitting/mesh/inverse_map.h"
#include "pipeline/patient/gravity_settings.h"
#include "pipeline/steps/breast_problem.h"
#include "pipeline/synthesize/coil_pressed.h"
#include "registration/carry/point_carrier.h"
#include "registration/search/edge_prior.h"
#include "registration/view/breast_middle.h"
#include "registration/view/laid_on_detector.h"
#include "registration/view/plate_turn.h"
#include "registration/view/view_of_plates.h"
#include "solver/gravity/unload.h"
#include "solver/press/compress.h"

namespace mammotwin {
namespace {

constexpr double kSkinFactor = 2;

CompressionSettings true_settings(const TrueTissue& tissue) {
  CompressionSettings s;
  const double lesion_over_gland = s.lesion.c1_kpa / s.fibroglandular.c1_kpa;
  s.fibroglandular.c1_kpa = tissue.stiffness_ratio * s.fat.c1_kpa;
  s.lesion.c1_kpa = lesion_over_gland * s.fibroglandular.c1_kpa;
  for (LawSettings* law : {&s.fat, &s.fibroglandular, &s.lesion}) {
    law->law = LawName::exponential;
    law->stiffening = tissue.stiffening;
  }
  s.boundary.chest_wall_spring *= tissue.springs;
  s.boundary.wall_smoothing = 0;  // as it was drawn
  s.skin.c1 *= kSkinFactor;
  s.paddle_tilt_deg = tissue.paddle_tilt_deg;
  s.friction.coefficient = tissue.friction;
  return s;
}

MeshFile true_mesh(const Segmentation& truth, const Eigen::Vector3i& elements) {
  FitOptions options;
  options.elements = elements;
  const FitResult fit = fit_breast(truth, options, {});
  if (!fit.report.usable())
    throw std::runtime_error("truth: no mesh of the true breast: " + fit.report.reasons.front());
  return fit.mesh;
}

MeshFile unloaded_truth(const Segmentation& truth, const DrawnPatient& drawn) {
  MeshFile file = true_mesh(truth, drawn.true_elements);
  const TissueSampler tissue = tissue_of(file, truth.fractions);
  BreastProblem problem = breast_problem(file, tissue, true_settings(drawn.tissue), 1);
  problem.gravity = gravity_in_lps(Pose::prone);
  problem.density = GravitySettings().density();
  UnloadOptions options;
  options.check = false;
  const UnloadResult result = unload(problem, options);
  if (!result.report.usable()) throw std::runtime_error("truth: " + result.report.reason);
  file.configurations["prone"] = file.mesh.nodes();
  file.mesh = HermiteMesh(result.unloaded, file.mesh.elements());
  return file;
}

}  // namespace

TrueBreast::TrueBreast(const SyntheticPatient& patient, const DrawnPatient& drawn)
    : truth_(true_segmentation(patient.tissue, patient.labels, patient.truth)),
      tissue_(drawn.tissue),
      side_(drawn.patient.anatomy.side),
      unloaded_(unloaded_truth(truth_, drawn)),
      prone_(unloaded_.configurations.at("prone"), unloaded_.mesh.elements()) {}

CompressionProblem TrueBreast::problem(const CompressionSettings& settings, Pose pose) const {
  CompressionProblem problem{
      breast_problem(unloaded_, tissue_of(unloaded_, truth_.fractions), settings, 1), {}, {}};
  problem.gravity = gravity_in_lps(pose);
  problem.density = GravitySettings().density();
  problem.friction = settings.friction;
  return problem;
}

HermiteMesh TrueBreast::between_coil_plates(double share) const {
  const CompressionSettings settings = true_settings(tissue_);
  const CompressionResult result =
      press_between_coil_plates(problem(settings, Pose::prone), settings, share);
  return HermiteMesh(result.deformed, unloaded_.mesh.elements());
}

TrueView TrueBreast::laid(TrueView shown, const DrawnView& drawn) const {
  CompressedView& view = shown.view;
  if (!is_oblique(view.angle_deg)) {
    const double aside_mm = breast_middle_mm(shown.compressed, view.frame) + drawn.shift_mm;
    view = laid_on_detector(view, 0, {-drawn.edge_mm, -aside_mm});
    return shown;
  }
  const Eigen::Vector3d nipple =
      PointCarrier(prone_, shown.compressed).carry(truth_.nipple_in_lps).in_lps;
  const Eigen::Vector2d at = view.frame.view_from_lps(nipple).head<2>();
  MeshFile file = unloaded_;
  file.mesh = shown.compressed;
  const WallLine wall = wall_line(file, view, nipple);
  const auto on_wall = [&](double aside_mm) {
    return view.frame.lps_from_view(
        {wall.depth_at(aside_mm), at.y() + aside_mm, view.thickness_mm / 2});
  };
  shown.wall = {on_wall(0), on_wall(1)};
  const Eigen::Vector2d shift = shift_of_turned(drawn.laid_turn_deg, shown.compressed, view, nipple,
                                                drawn.nipple_share * wall.to_nipple_mm(at));
  view = laid_on_detector(view, drawn.laid_turn_deg, {shift.x(), shift.y() - drawn.shift_mm});
  return shown;
}

TrueView TrueBreast::compress_view(const DrawnView& drawn) const {
  const CompressionSettings settings = true_settings(tissue_);
  CompressionProblem problem = this->problem(settings, Pose::standing);
  const double angle_deg = drawn.header_angle_deg + drawn.roll_deg;
  const double turn_deg =
      usual_turn_deg(unloaded_, InverseMap(prone_).nearest(truth_.nipple_in_lps), side_,
                     angle_deg) -
      drawn.turn_deg;
  const Eigen::Matrix3d axes = axes_of(side_, angle_deg, turn_deg);
  settings.shape_plates(problem.plates);
  problem.plates.depth = axes.row(0);
  problem.plates.up = axes.row(2);
  problem.plates.lift = drawn.lift_mm;
  problem.plates.wall_clearance = drawn.clearance_mm;
  problem.plates.thickness =
      (1 - drawn.compressed_fraction) * free_thickness(prone_file(unloaded_), problem.plates);
  const CompressionResult result = compress(problem, settings.options);
  if (!result.report.usable())
    throw std::runtime_error("truth: " + drawn.name + ": " + result.report.reason);

  return laid({view_of_plates(drawn.name, side_, angle_deg, turn_deg, problem.plates, result),
               HermiteMesh(result.deformed, unloaded_.mesh.elements()),
               std::round(10 * (result.report.thickness_mm + drawn.thickness_error_mm)) / 10,
               drawn.marker, is_oblique(angle_deg) || drawn.edge_mm < 0},
              drawn);
}

}  // namespace mammotwin
