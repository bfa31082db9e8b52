#pragma once

#include <Eigen/Core>

#include "registration/mammogram/mammogram_image.h"
#include "registration/view/detector.h"

namespace mammotwin {

/// A mammogram with its chest wall on the left, in pixels of about 0.4 mm: what is looked for in it
/// is millimetres large. Places in it are (depth from the image's chest-wall edge, from its top)
/// [mm].
class UprightImage {
 public:
  static constexpr double kPixel_mm = 0.4;

  /// pixel_mm: of `image`. Throws std::invalid_argument unless it is 0.02 to 0.5 mm.
  UprightImage(const MammogramImage& image, double pixel_mm);

  /// The same with the chest wall at another edge of the mammogram.
  void hang(ImageEdge chest_wall);

  const MammogramImage& image() const { return image_; }
  MammogramImage& image() { return image_; }
  ImageEdge chest_wall() const { return chest_wall_; }
  double pixel_mm() const { return pixel_mm_; }
  double depth_mm() const { return image_.columns * pixel_mm_; }
  double height_mm() const { return image_.rows * pixel_mm_; }

  /// Grey at a place, of the nearest pixel; beyond the image that of its border.
  float at(const Eigen::Vector2d& place) const;

  /// Pixel (column, row) of the mammogram as it is stored, and back.
  Eigen::Vector2d stored_pixel(const Eigen::Vector2d& place) const;
  Eigen::Vector2d place(const Eigen::Vector2d& stored_pixel) const;

 private:
  MammogramImage image_;
  ImageEdge chest_wall_ = ImageEdge::left;
  int factor_;
  double stored_pixel_mm_, pixel_mm_;
};

}  // namespace mammotwin
