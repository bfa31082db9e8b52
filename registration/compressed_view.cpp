#include "registration/compressed_view.h"

#include <stdexcept>

namespace mammotwin {
namespace {

using Metadata = std::map<std::string, std::vector<double>>;

const std::vector<double>& entry(const Metadata& metadata, const std::string& file,
                                 const std::string& key, std::size_t count) {
  const auto found = metadata.find(key);
  if (found == metadata.end())
    throw std::runtime_error(file + ": the field " + key +
                             " is missing; expected a mesh written by mammotwin-compress");
  if (found->second.size() != count)
    throw std::runtime_error(file + ": the field " + key + " has " +
                             std::to_string(found->second.size()) + " numbers; expected " +
                             std::to_string(count));
  return found->second;
}

}  // namespace

CompressedView compressed_view(const std::string& name, const std::string& file,
                               const Metadata& metadata) {
  CompressedView view;
  view.name = name;
  view.side = entry(metadata, file, "view_side", 1)[0] == 0 ? Side::left : Side::right;
  view.angle_deg = entry(metadata, file, "view_angle_deg", 1)[0];
  view.thickness_mm = entry(metadata, file, "thickness_mm", 1)[0];
  view.frame.origin_in_lps =
      Eigen::Vector3d(entry(metadata, file, "view_origin_lps_mm", 3).data());
  view.frame.axes = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>(
      entry(metadata, file, "view_axes", 9).data());
  const double difference =
      (view.frame.axes - view_axes(view.side, view.angle_deg)).cwiseAbs().maxCoeff();
  if (!(difference < 1e-6))  // the same formula in double precision, written and read exactly
    throw std::runtime_error(file + ": view_axes differs by " + std::to_string(difference) +
                             " from the axes of view_side and view_angle_deg; run compress again");
  return view;
}

}  // namespace mammotwin
