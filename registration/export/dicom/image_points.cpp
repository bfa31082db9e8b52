#include "registration/export/dicom/image_points.h"

#include <cmath>
#include <numbers>

namespace mammotwin::dicom {

std::vector<Float32> on_image(const Detector& detector, const std::vector<Eigen::Vector2d>& uv) {
  std::vector<Float32> data;
  for (const Eigen::Vector2d& x : uv) {
    const Eigen::Vector2d pixel = detector.image_from_detector(x) + Eigen::Vector2d::Ones();
    data.insert(data.end(), {static_cast<Float32>(pixel.x()), static_cast<Float32>(pixel.y())});
  }
  return data;
}

std::vector<Eigen::Vector2d> ends_of(const AnnotatedMark& mark) {
  const double t = mark.ellipse.angle_deg * std::numbers::pi / 180;
  const Eigen::Vector2d along(std::cos(t), std::sin(t)), across(-std::sin(t), std::cos(t));
  return {mark.on_detector - mark.ellipse.major_mm * along,
          mark.on_detector + mark.ellipse.major_mm * along,
          mark.on_detector - mark.ellipse.minor_mm * across,
          mark.on_detector + mark.ellipse.minor_mm * across};
}

}  // namespace mammotwin::dicom
