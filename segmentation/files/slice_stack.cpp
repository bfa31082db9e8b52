#include "segmentation/files/slice_stack.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>
#include <stdexcept>

#include "segmentation/image/order_statistics.h"

namespace mammotwin {
namespace {

constexpr double parallel_tolerance = 1e-3;  // sine of the angle between normals: 0.06 degrees
constexpr double gap_factor = 1.5;           // over the median distance: a slice is missing
constexpr double sideways_mm = 0.5;          // half of a usual pixel

std::string placed(const SlicePlacement& slice, double along) {
  std::ostringstream text;
  text.setf(std::ios::fixed);
  text.precision(1);
  text << slice.name << " (at " << along << " mm)";
  return text.str();
}

[[noreturn]] void refuse(const std::string& message) { throw std::runtime_error(message); }

void check_matching(const std::vector<SlicePlacement>& slices) {
  const SlicePlacement& first = slices.front();
  for (const SlicePlacement& slice : slices) {
    if (slice.rows != first.rows || slice.columns != first.columns)
      refuse("slices differ in matrix: " + first.name + " has " + std::to_string(first.rows) +
             " x " + std::to_string(first.columns) + " pixels, " + slice.name + " " +
             std::to_string(slice.rows) + " x " + std::to_string(slice.columns) +
             "; expected one size throughout (are two acquisitions in one folder?)");
    if (std::abs(slice.row_spacing - first.row_spacing) > 1e-3 ||
        std::abs(slice.column_spacing - first.column_spacing) > 1e-3)
      refuse("slices differ in pixel spacing: " + first.name + " and " + slice.name +
             "; expected one spacing throughout");
    if (slice.normal().cross(first.normal()).norm() > parallel_tolerance ||
        std::abs(slice.along_row.dot(first.along_row) - 1) > parallel_tolerance)
      refuse("slices are not parallel: " + first.name + " and " + slice.name +
             " are oriented differently; expected one stack of parallel slices (a localiser or a "
             "mixed series cannot serve; choose a three-dimensional series)");
  }
}

/// Names every hole, the widest first.
void check_holes(const std::vector<SlicePlacement>& slices, const std::vector<std::size_t>& order,
                 const std::vector<double>& steps, double median) {
  std::vector<std::size_t> holes;
  for (std::size_t n = 0; n < steps.size(); ++n)
    if (steps[n] > gap_factor * median) holes.push_back(n);
  if (holes.empty()) return;
  std::stable_sort(holes.begin(), holes.end(),
                   [&](std::size_t a, std::size_t b) { return steps[a] > steps[b]; });
  const Eigen::Vector3d normal = slices.front().normal();
  std::ostringstream text;
  text.setf(std::ios::fixed);
  text.precision(1);
  text << "slices are missing: ";
  for (std::size_t n = 0; n < holes.size(); ++n) {
    const SlicePlacement& a = slices[order[holes[n]]];
    const SlicePlacement& b = slices[order[holes[n] + 1]];
    text << (n ? ", and " : "") << "a hole of " << steps[holes[n]] << " mm between "
         << placed(a, a.position.dot(normal)) << " and " << placed(b, b.position.dot(normal));
  }
  text << "; expected one slice every " << median << " mm (export the series again)";
  refuse(text.str());
}

}  // namespace

bool has_repeated_positions(const std::vector<SlicePlacement>& slices) {
  std::vector<double> along;
  for (const SlicePlacement& slice : slices)
    along.push_back(slice.position.dot(slices.front().normal()));
  std::sort(along.begin(), along.end());
  for (std::size_t n = 1; n < along.size(); ++n)
    if (along[n] - along[n - 1] < same_place_mm) return true;
  return false;
}

SliceStack stack_slices(const std::vector<SlicePlacement>& slices) {
  if (slices.size() < 2)
    refuse(
        "holds one two-dimensional image; expected a three-dimensional breast MRI (a folder with "
        "all slices of one series)");
  check_matching(slices);
  const Eigen::Vector3d normal = slices.front().normal();
  const auto along = [&](std::size_t n) { return slices[n].position.dot(normal); };

  SliceStack stack;
  stack.order.resize(slices.size());
  std::iota(stack.order.begin(), stack.order.end(), std::size_t{0});
  std::stable_sort(stack.order.begin(), stack.order.end(),
                   [&](std::size_t a, std::size_t b) { return along(a) < along(b); });

  std::vector<double> steps;
  for (std::size_t n = 1; n < slices.size(); ++n)
    steps.push_back(along(stack.order[n]) - along(stack.order[n - 1]));
  std::vector<double> sorted = steps;
  const double usual = median(sorted);

  check_holes(slices, stack.order, steps, usual);
  for (std::size_t n = 0; n < steps.size(); ++n) {
    const std::size_t a = stack.order[n], b = stack.order[n + 1];
    const std::string pair = placed(slices[a], along(a)) + " and " + placed(slices[b], along(b));
    if (steps[n] < same_place_mm)
      refuse("two slices stand at one place: " + pair +
             "; expected each slice once (remove the copy, or name the phase with mri.series)");
    const Eigen::Vector3d between = slices[b].position - slices[a].position;
    if ((between - between.dot(normal) * normal).norm() > sideways_mm)
      refuse("slices shift sideways between " + pair + "; expected a straight stack");
  }
  stack.spacing = (along(stack.order.back()) - along(stack.order.front())) / steps.size();
  return stack;
}

}  // namespace mammotwin
