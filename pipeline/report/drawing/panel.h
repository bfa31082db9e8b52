#pragma once

#include <string>
#include <utility>
#include <vector>

#include "pipeline/report/drawing/picture.h"
#include "pipeline/report/drawing/section.h"

namespace mammotwin {

/// A section drawn into a rectangle of a picture at a scale, with its marks in mm.
class Panel {
 public:
  /// Upper left corner at (x, y) [pt]; `scale` in pt/mm. Draws nothing yet.
  Panel(Picture& picture, Section section, double x, double y, double scale)
      : picture_(picture), section_(std::move(section)), x_(x), y_(y), scale_(scale) {}

  double width() const { return section_.width_mm() * scale_; }
  double height() const { return section_.height_mm() * scale_; }
  const Section& section() const { return section_; }
  Eigen::Vector2d at(const Eigen::Vector3d& x) const {
    return Eigen::Vector2d(x_, y_) + scale_ * section_.on_paper(x);
  }

  void image(const Raster& raster) { picture_.image(raster, x_, y_, width(), height()); }
  using Pieces = std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>>;
  void pieces(const Pieces& pieces, const Stroke& stroke);
  /// A line that is seen on any grey: `width` [pt] of the colour between light and dark edges.
  void edged_pieces(const Pieces& pieces, const Colour& colour, double width);
  void edge_line(const Eigen::Vector3d& from, const Eigen::Vector3d& to);  ///< the detector's edge
  void frame();
  /// Words at the middle of each side: left, right, top, bottom.
  void sides(const std::string& left, const std::string& right, const std::string& top,
             const std::string& bottom, bool on_image);
  void scale_bar(double mm, const Colour& colour);
  void title(const std::string& text);

  /// Words beside a mark.
  void label(const Eigen::Vector3d& x, double away_mm, const std::string& text);
  /// A lesion: a ring of the given radius and its name.
  void lesion_mark(const Eigen::Vector3d& x, double radius_mm, const std::string& name,
                   bool on_image);
  void nipple_triangle(const Eigen::Vector3d& x);
  void nipple_mark(const Eigen::Vector3d& x, bool on_image);  ///< triangle and name
  void baseline_mark(const Eigen::Vector3d& x);

 private:
  Picture& picture_;
  Section section_;
  double x_, y_, scale_;
};

}  // namespace mammotwin
