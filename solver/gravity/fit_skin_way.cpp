#include "solver/gravity/fit_skin_way.h"

#include <algorithm>
#include <cmath>

#include "solver/gravity/inverse_equilibrium.h"

namespace mammotwin {
namespace {

constexpr double kMostWay_mm = 60, kStride_mm = 6, kFigurePrecision = 0.001;
constexpr int kMostHalvings = 4;

struct Trial {
  State reference;
  double way_mm, figure;
};

}  // namespace

SkinWayFit fit_skin_way(const BreastProblem& imaged, const ShapeFigure& figure, double wanted,
                        const UnloadOptions& options, const Progress& progress) {
  const Eigen::Vector3d weight = imaged.density * imaged.gravity;
  InverseEquilibrium inverse(imaged, options.solid);
  SkinWayFit fit;
  const auto at = [&](double way_mm, State& state) {
    ++fit.trials;
    inverse.set_skin_way(way_mm);
    return inverse.solve(state, weight, options.tolerance, options.max_iterations).converged;
  };
  State start = inverse.start();
  const LoadSteppingReport hung =
      inverse.raise(start, weight, 0, options.load, options.tolerance, options.max_iterations,
                    [](const LoadSteppingReport&, const State&, const NewtonReport&) {});
  fit.reason = hung.reason;
  if (!hung.complete()) return fit;

  Trial near{start, 0, figure(start.x)}, far = near;
  const double first = near.figure;
  double stride = kStride_mm;
  for (int halvings = 0; far.figure < wanted && near.way_mm + stride <= kMostWay_mm;) {
    if (progress)
      progress(std::max(0.0, (near.figure - first) / (wanted - first)),
               "letting go what pressed the skin");
    far = {near.reference, near.way_mm + stride, 0};
    if (!at(far.way_mm, far.reference)) {
      far = near;
      stride /= 2;
      if (++halvings > kMostHalvings) break;
      continue;
    }
    far.figure = figure(far.reference.x);
    if (far.figure < wanted) near = far;
  }
  fit.way_mm = far.way_mm;
  fit.figure = far.figure;
  if (far.figure < wanted) {
    fit.reason =
        near.way_mm + stride > kMostWay_mm ? "not with 60 mm" : "no shape free of load beyond";
    return fit;
  }
  while (std::abs(fit.figure - wanted) > kFigurePrecision && far.way_mm - near.way_mm > 0.1) {
    const double share = (wanted - near.figure) / (far.figure - near.figure);
    Trial middle{near.reference, near.way_mm + share * (far.way_mm - near.way_mm), 0};
    if (!at(middle.way_mm, middle.reference)) break;
    middle.figure = figure(middle.reference.x);
    fit.way_mm = middle.way_mm;
    fit.figure = middle.figure;
    (middle.figure < wanted ? near : far) = std::move(middle);
  }
  return fit;
}

}  // namespace mammotwin
