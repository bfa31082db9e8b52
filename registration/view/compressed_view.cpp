#include "registration/view/compressed_view.h"

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "fitting/mesh/metadata_field.h"

namespace mammotwin {
namespace {

const std::vector<double>& entry(const Metadata& metadata, const std::string& file,
                                 const std::string& key, std::size_t count) {
  if (const auto* numbers = find_field(metadata, file, key, count)) return *numbers;
  throw std::runtime_error(file + ": the field " + key +
                           " is missing; expected a mesh written by mammotwin-compress");
}

}  // namespace

Eigen::Matrix3d axes_of(Side side, double angle_deg, double turn_deg) {
  const Eigen::Matrix3d axes = view_axes(side, angle_deg);
  const double t = turn_deg * std::numbers::pi / 180;
  Eigen::Matrix3d turned = axes;
  turned.row(0) = std::cos(t) * axes.row(0) - std::sin(t) * axes.row(1);
  turned.row(1) = std::sin(t) * axes.row(0) + std::cos(t) * axes.row(1);
  return turned;
}

void write_view(const CompressedView& view, Metadata& metadata) {
  metadata["view_side"] = {view.side == Side::left ? 0.0 : 1.0};
  metadata["view_angle_deg"] = {view.angle_deg};
  metadata["thickness_mm"] = {view.thickness_mm};
  metadata["view_origin_lps_mm"] = {view.frame.origin_in_lps.begin(),
                                    view.frame.origin_in_lps.end()};
  const Eigen::Matrix3d columns = view.frame.axes.transpose();
  metadata["view_axes"] = {columns.data(), columns.data() + columns.size()};
  metadata["view_swing_mm"] = {view.escape.swing_mm};
  metadata["view_roll_deg"] = {view.escape.roll_deg};
  metadata["view_slid_mm"] = {view.escape.slid_mm};
  if (view.turn_deg != 0) metadata["view_turn_deg"] = {view.turn_deg};
}

CompressedView compressed_view(const std::string& name, const std::string& file,
                               const Metadata& metadata) {
  CompressedView view;
  view.name = name;
  view.side = entry(metadata, file, "view_side", 1)[0] == 0 ? Side::left : Side::right;
  view.angle_deg = entry(metadata, file, "view_angle_deg", 1)[0];
  view.thickness_mm = entry(metadata, file, "thickness_mm", 1)[0];
  view.frame.origin_in_lps = Eigen::Vector3d(entry(metadata, file, "view_origin_lps_mm", 3).data());
  view.frame.axes =
      Eigen::Matrix<double, 3, 3, Eigen::RowMajor>(entry(metadata, file, "view_axes", 9).data());
  view.escape.swing_mm = entry(metadata, file, "view_swing_mm", 1)[0];
  view.escape.roll_deg = entry(metadata, file, "view_roll_deg", 1)[0];
  view.escape.slid_mm = entry(metadata, file, "view_slid_mm", 1)[0];
  if (metadata.contains("view_turn_deg"))
    view.turn_deg = entry(metadata, file, "view_turn_deg", 1)[0];
  const double difference =
      (view.frame.axes - axes_of(view.side, view.angle_deg, view.turn_deg)).cwiseAbs().maxCoeff();
  if (!(difference < 1e-6))  // the same formula in double precision, written and read exactly
    throw std::runtime_error(file + ": view_axes differs by " + std::to_string(difference) +
                             " from the axes of view_side and view_angle_deg; run compress again");
  return view;
}

}  // namespace mammotwin
