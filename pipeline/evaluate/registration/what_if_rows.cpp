#include "pipeline/evaluate/registration/what_if_rows.h"

#include <algorithm>
#include <cmath>
#include <ctime>
#include <optional>
#include <random>
#include <stdexcept>

#include "pipeline/evaluate/cases/stage_command.h"
#include "pipeline/evaluate/compression/pressed_places.h"
#include "pipeline/patient/patient.h"
#include "pipeline/steps/breast_problem.h"
#include "pipeline/steps/view_problem.h"
#include "registration/search/what_if.h"
#include "segmentation/segmentation_file.h"
#include "solver/press/compress.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

constexpr int kStateSeed = 28;
constexpr std::size_t kSeenPoints = 200;

double cpu_so_far() { return static_cast<double>(std::clock()) / CLOCKS_PER_SEC; }

/// Shares of the ranges, in [-1, 1].
std::vector<ViewState> drawn_states(int count) {
  std::mt19937 random(kStateSeed);
  std::vector<ViewState> states(count, ViewState::Zero());
  for (ViewState& state : states)
    for (const WhatIf& varied : kWhatIf) state[varied.number] = random() / 2147483648.0 - 1;
  return states;
}

/// Sorted off their place, over states and points.
struct Distances {
  std::vector<double> lesions, tissue;

  void sort() {
    std::sort(lesions.begin(), lesions.end());
    std::sort(tissue.begin(), tissue.end());
  }
};

double share_of_sorted(const std::vector<double>& values, double share) {
  return values[static_cast<std::size_t>(std::ceil(share * values.size())) - 1];
}

void put(const Distances& off, const std::string& what, json& row) {
  row["tissue_" + what + "median_mm"] = median_of_sorted(off.tissue);
  row["tissue_" + what + "p95_mm"] = share_of_sorted(off.tissue, 0.95);
  if (off.lesions.empty()) return;
  row["lesion_" + what + "median_mm"] = median_of_sorted(off.lesions);
  row["lesion_" + what + "max_mm"] = off.lesions.back();
}

/// Evenly from the breast's volume as it was imaged, always the same.
std::vector<MeshPoint> drawn_points(const HermiteMesh& prone) {
  constexpr int kDrawn = 4000;
  std::mt19937 random(kStateSeed);
  const auto share = [&] { return random() / 4294967296.0; };
  std::vector<MeshPoint> drawn;
  std::vector<double> volumes;  // a unit of xi's
  for (int n = 0; n < kDrawn; ++n) {
    const int element = static_cast<int>(share() * prone.num_elements());
    drawn.push_back({element, {share(), share(), share()}});
    volumes.push_back(prone.jacobian(drawn.back()).determinant());
  }
  const double largest = *std::max_element(volumes.begin(), volumes.end());
  std::vector<MeshPoint> kept;
  for (int n = 0; n < kDrawn; ++n)
    if (share() * largest < volumes[n]) kept.push_back(drawn[n]);
  return kept;
}

/// Where material points are seen when a view's nodes stand so: lesions, and tissue that the base
/// has in front of the detector's edge.
class Seen {
 public:
  Seen(const MeshFile& pressed, const std::vector<Eigen::Vector3d>& lesions_in_prone,
       const Nodes& base)
      : elements_(pressed.mesh.elements()) {
    const HermiteMesh prone = prone_file(pressed).mesh, seen(base, elements_);
    const InverseMap inverse(prone);
    for (const Eigen::Vector3d& x : lesions_in_prone) lesions_.push_back(inverse.nearest(x));
    for (const MeshPoint& point : drawn_points(prone))
      if (tissue_.size() < kSeenPoints && seen.position(point).x() > 0) tissue_.push_back(point);
  }

  void compare(const Nodes& a, const Nodes& b, Distances& off) const {
    const HermiteMesh mesh_a(a, elements_), mesh_b(b, elements_);
    const Detector detector;
    const auto add = [&](const std::vector<MeshPoint>& points, std::vector<double>& distances) {
      for (const MeshPoint& point : points)
        distances.push_back(
            (detector.project(mesh_a.position(point)) - detector.project(mesh_b.position(point)))
                .norm());
    };
    add(lesions_, off.lesions);
    add(tissue_, off.tissue);
  }

 private:
  const std::vector<HermiteMesh::Corners> elements_;
  std::vector<MeshPoint> lesions_, tissue_;
};

struct TimedModel {
  std::string name;
  ReducedView view;
  double cpu_seconds;
  Distances off{};
};

TimedModel timed(const std::string& name, const std::function<ReducedView()>& make) {
  const double before = cpu_so_far();
  ReducedView view = make();
  return {name, std::move(view), cpu_so_far() - before};
}

/// The breast up to its compression, which is returned.
fs::path pressed(const WhatIfCase& asked) {
  const auto file = [&](const char* name) { return asked.folder / name; };
  const std::vector<std::string> labels = {file("segmentation.seg.nrrd").string(),
                                           file("fractions.nrrd").string()};
  const auto run = [&](const std::string& stage, std::vector<std::string> inputs,
                       const fs::path& product) {
    run_to_product({stage, std::move(inputs), product, asked.patient_toml});
    return product;
  };
  const auto with = [&](const fs::path& mesh) {
    return std::vector<std::string>{labels[0], labels[1], mesh.string()};
  };
  run("segment", {}, labels[0]);
  const fs::path prone = run("fit", labels, file("prone.vtu"));
  const fs::path unloaded = run("unload", with(prone), file("unloaded.vtu"));
  std::vector<std::string> inputs = with(unloaded);
  inputs.insert(inputs.begin(), asked.view);
  return run("compress", inputs, asked.folder / (asked.view + ".vtu"));
}

/// One breast pressed, ready to be pressed otherwise.
class WhatIfRun {
 public:
  explicit WhatIfRun(const WhatIfCase& asked)
      : asked_(asked), product_(pressed(asked)), file_(read_mesh_file(product_)) {
    patient_.read(asked.patient_toml);
    const fs::path labels = asked.folder / "segmentation.seg.nrrd";
    const Segmentation segmentation = read_segmentation(labels, fractions_beside(labels));
    view_ = compressed_view(asked.view, product_.filename(), file_.metadata);
    solver_ = nearby_solver(patient_, view_, file_, tissue_of(file_, segmentation.fractions));
    if (!solver_) throw std::runtime_error(product_.string() + ": holds no solution to go on from");
    models_.push_back(timed("slopes", [&] { return linear_view(*solver_, what_if_ranges()); }));
    models_.push_back(timed("quadratic", [&] {
      std::vector<int> numbers;
      for (const WhatIf& varied : kWhatIf) numbers.push_back(varied.number);
      return reduce_view(*solver_, what_if_ranges(), numbers);
    }));
    seen_.emplace(file_, FollowedPoints(labels, asked.folder / "prone.vtu").lesions, base());
  }

  void compare_at(const ViewState& z) {
    const double before = cpu_so_far();
    const std::optional<Nodes> truth = press(z.cwiseProduct(what_if_ranges()));
    solve_seconds_ += cpu_so_far() - before;
    if (!truth) {
      ++unsolved_;
      return;
    }
    seen_->compare(base(), *truth, moved_);
    for (TimedModel& model : models_) seen_->compare(model.view.nodes_at(z), *truth, model.off);
  }

  std::vector<json> rows() {
    moved_.sort();
    std::vector<json> all;
    for (TimedModel& model : models_) {
      model.off.sort();
      all.push_back(row_of(model));
    }
    return all;
  }

 private:
  const Nodes& base() const { return models_.front().view.base; }

  /// Nodes in the view's frame; empty where no equilibrium is found.
  std::optional<Nodes> press(const ViewState& state) const {
    const CompressionProblem problem = solver_->problem_at(state);
    const CompressionResult result = compress(problem, patient_.compression.options);
    if (!result.report.usable()) return std::nullopt;
    return in_view(result.deformed, solver_->view_at(state, problem.plates, result).frame);
  }

  json row_of(const TimedModel& model) const {
    json row{{"name", asked_.name},
             {"view", asked_.view},
             {"model", model.name},
             {"states", asked_.states},
             {"unsolved", unsolved_},
             {"failed_solves", model.view.failed_solves},
             {"cpu_seconds", model.cpu_seconds},
             {"full_solve_cpu_seconds", solve_seconds_ / asked_.states}};
    for (const char* key : {"lesion_median_mm", "lesion_max_mm", "tissue_median_mm",
                            "tissue_p95_mm", "lesion_moved_median_mm", "lesion_moved_max_mm",
                            "tissue_moved_median_mm", "tissue_moved_p95_mm"})
      row[key] = nullptr;
    if (moved_.tissue.empty()) return row;
    put(model.off, "", row);
    put(moved_, "moved_", row);
    return row;
  }

  const WhatIfCase& asked_;
  const fs::path product_;
  const MeshFile file_;
  Patient patient_;
  CompressedView view_;
  std::optional<NearbySolver> solver_;
  std::vector<TimedModel> models_;
  std::optional<Seen> seen_;
  Distances moved_;
  int unsolved_ = 0;
  double solve_seconds_ = 0;
};

}  // namespace

void add_what_if_rows(const WhatIfCase& asked, const std::function<void(const json&)>& add) {
  fs::create_directories(asked.folder);
  WhatIfRun run(asked);
  for (const ViewState& z : drawn_states(asked.states)) run.compare_at(z);
  for (const json& row : run.rows()) add(row);
}

}  // namespace mammotwin
