#include "pipeline/evaluate/calibration/calibrated_breast.h"

#include <cmath>
#include <stdexcept>

#include "fitting/mesh/inverse_map.h"
#include "pipeline/evaluate/compression/pressed_places.h"
#include "pipeline/evaluate/compression/supine_points.h"
#include "pipeline/patient/patient.h"
#include "pipeline/steps/breast_problem.h"
#include "pipeline/steps/view_problem.h"
#include "registration/view/plate_turn.h"
#include "segmentation/segmentation_file.h"
#include "solver/gravity/pose_equilibria.h"
#include "solver/press/compress.h"

namespace mammotwin {
namespace {

using Nodes = std::vector<HermiteMesh::Node>;

constexpr double kLogStep = 1e-3;  // of central differences of residuals
// A median over points passes from one to the next, and a point sticks to its plate or slides:
// their slopes are taken over two per cent.
constexpr double kFigureLogStep = 0.02;
constexpr double kSteps = kFigureLogStep / (2 * kLogStep);

BreastFigures figures_of(const SupineMoves& moves, const CompressionResult& pressed) {
  return {moves.nipple.x(), moves.nipple.y(), moves.landmark_mm, moves.ribs_supine_mm,
          std::log(pressed.report.force_N)};
}

}  // namespace

/// What does not change with the numbers.
struct CalibratedBreast::Loaded {
  Patient patient;
  MeshFile prone{HermiteMesh({}, {}), {}, {}, {}, {}, {}};
  Side side;
  MeshPoint nipple;
  TissueSampler tissue;
  std::unique_ptr<SupinePoints> points;

  BreastProblem imaged(const CompressionSettings& settings) const {
    BreastProblem problem = breast_problem(prone, tissue, settings, settings.stiffness_factor);
    problem.gravity = gravity_in_lps(Pose::prone);
    problem.density = patient.gravity.density();
    return problem;
  }
  /// In CC. Where the imaged shape holds up to a share of its weight only, the breast is taken to
  /// be so much stiffer, as by mammotwin-unload.
  CompressionProblem pressed(CompressionSettings settings, const Nodes& unloaded, double share) {
    settings.stiffness_factor /= share;
    MeshFile mesh = prone;
    mesh.configurations["prone"] = prone.mesh.nodes();
    mesh.mesh = HermiteMesh(unloaded, prone.mesh.elements());
    const CompressionSettings kept = patient.compression;
    patient.compression = settings;
    CompressionProblem problem = view_problem(
        patient, patient.cc, usual_axes(mesh, nipple, side, patient.cc.angle()), mesh, tissue);
    patient.compression = kept;
    return problem;
  }
};

struct CalibratedBreast::Solved {
  std::vector<TissueNumber> numbers;
  std::vector<double> values;
  std::unique_ptr<PoseEquilibria> lying;
  CompressionResult pressed;
};

CalibratedBreast::CalibratedBreast(const std::filesystem::path& folder)
    : name_(folder.filename().string()), loaded_(std::make_unique<Loaded>()) {
  loaded_->patient.read(folder / "patient.toml");
  const std::filesystem::path labels = folder / "segmentation.seg.nrrd";
  const Segmentation segmentation = read_segmentation(labels, fractions_beside(labels));
  const Side side = segmentation.region.side;
  loaded_->prone = read_mesh_file(folder / "prone.vtu");
  loaded_->tissue = tissue_of(loaded_->prone, segmentation.fractions);
  loaded_->points =
      std::make_unique<SupinePoints>(loaded_->prone, side, segmentation.nipple_in_lps);
  loaded_->side = side;
  loaded_->nipple = InverseMap(loaded_->prone.mesh).nearest(segmentation.nipple_in_lps);
}
CalibratedBreast::~CalibratedBreast() = default;
CalibratedBreast::CalibratedBreast(CalibratedBreast&&) noexcept = default;

const CompressionSettings& CalibratedBreast::settings() const {
  return loaded_->patient.compression;
}

double CalibratedBreast::thickness_mm() const { return loaded_->patient.cc.thickness_mm.value(); }

CompressionSettings CalibratedBreast::settings_at(std::size_t number, double log_change) const {
  CompressionSettings settings = loaded_->patient.compression;
  for (std::size_t n = 0; n < solved_->numbers.size(); ++n)
    solved_->numbers[n].set(settings,
                            solved_->values[n] * (n == number ? std::exp(log_change) : 1.0));
  return settings;
}

BreastFigures CalibratedBreast::solve(const std::vector<TissueNumber>& numbers,
                                      const std::vector<double>& values) {
  solved_ = std::make_unique<Solved>();
  solved_->numbers = numbers;
  solved_->values = values;
  const CompressionSettings settings = settings_at(0, 0);
  solved_->lying =
      std::make_unique<PoseEquilibria>(loaded_->imaged(settings), gravity_in_lps(Pose::supine));
  const PoseEquilibria& lying = *solved_->lying;
  if (!lying.usable()) throw std::runtime_error("on her back: " + lying.reason());
  const CompressionProblem problem =
      loaded_->pressed(settings, lying.unloaded(), lying.gravity_share());
  solved_->pressed = compress(problem, settings.options);
  if (!solved_->pressed.report.usable())
    throw std::runtime_error("in CC: " + solved_->pressed.report.reason);
  return figures_of(loaded_->points->moves(lying.posed()), solved_->pressed);
}

std::vector<BreastFigures> CalibratedBreast::slopes() const {
  if (!solved_) throw std::logic_error("no slopes of a breast that was not solved");
  const PoseEquilibria& lying = *solved_->lying;
  const double share = lying.gravity_share();
  std::vector<BreastFigures> slopes;
  for (std::size_t n = 0; n < solved_->numbers.size(); ++n) {
    const CompressionSettings below = settings_at(n, -kLogStep), above = settings_at(n, kLogStep);
    const PoseEquilibria::Step step = lying.step(loaded_->imaged(below), loaded_->imaged(above));
    const auto figures = [&](double sign) {
      const SupineMoves moves =
          loaded_->points->moves(combined(1, lying.posed(), sign * kSteps, step.posed));
      const CompressionProblem problem =
          loaded_->pressed(settings_at(n, sign * kFigureLogStep),
                           combined(1, lying.unloaded(), sign * kSteps, step.unloaded), share);
      CompressionResult pressed = compress_from(solved_->pressed, problem, settings().options);
      if (!pressed.report.usable()) pressed = compress(problem, settings().options);
      if (!pressed.report.usable())
        throw std::runtime_error(name_ + " next to it in CC: " + pressed.report.reason);
      return figures_of(moves, pressed);
    };
    BreastFigures slope = figures(1);
    const BreastFigures below_figures = figures(-1);
    for (int i = 0; i < kBreastFigures; ++i)
      slope[i] = (slope[i] - below_figures[i]) / (2 * kFigureLogStep);
    slopes.push_back(slope);
  }
  return slopes;
}

}  // namespace mammotwin
