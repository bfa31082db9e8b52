#include "registration/mammogram/upright_image.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "registration/mammogram/mammogram_masks.h"

namespace mammotwin {

UprightImage::UprightImage(const MammogramImage& image, double pixel_mm)
    : factor_(std::max(1, static_cast<int>(std::lround(kPixel_mm / pixel_mm)))),
      stored_pixel_mm_(pixel_mm),
      pixel_mm_(factor_ * pixel_mm) {
  if (!(pixel_mm >= 0.02 && pixel_mm <= 0.5))
    throw std::invalid_argument("a mammogram's pixel is " + std::to_string(pixel_mm) +
                                " mm; expected 0.02 to 0.5");
  image_ = shrunk(image, factor_);
}

void UprightImage::hang(ImageEdge chest_wall) {
  if (chest_wall == chest_wall_) return;
  chest_wall_ = chest_wall;
  for (int row = 0; row < image_.rows; ++row) {
    const auto begin = image_.grey.begin() + static_cast<std::ptrdiff_t>(row) * image_.columns;
    std::reverse(begin, begin + image_.columns);
  }
}

float UprightImage::at(const Eigen::Vector2d& place) const {
  const int column = static_cast<int>(std::floor(place.x() / pixel_mm_));
  const int row = static_cast<int>(std::floor(place.y() / pixel_mm_));
  return image_.at(std::clamp(column, 0, image_.columns - 1), std::clamp(row, 0, image_.rows - 1));
}

Eigen::Vector2d UprightImage::stored_pixel(const Eigen::Vector2d& place) const {
  const Eigen::Vector2d hung = place / stored_pixel_mm_ - Eigen::Vector2d(0.5, 0.5);
  if (chest_wall_ == ImageEdge::left) return hung;
  // What is left over by the shrinking lies at the right: there the wall is.
  const double used = image_.columns * factor_;
  return {used - 1 - hung.x(), hung.y()};
}

Eigen::Vector2d UprightImage::place(const Eigen::Vector2d& stored_pixel) const {
  Eigen::Vector2d hung = stored_pixel;
  if (chest_wall_ == ImageEdge::right) hung.x() = image_.columns * factor_ - 1 - stored_pixel.x();
  return (hung + Eigen::Vector2d(0.5, 0.5)) * stored_pixel_mm_;
}

}  // namespace mammotwin
