#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

struct _cairo;
struct _cairo_surface;

namespace mammotwin {

struct Colour {
  double red = 0, green = 0, blue = 0, alpha = 1;  ///< each in [0, 1]
};

/// Pixels of a raster image, row by row from the top.
struct Raster {
  int width = 0, height = 0;
  std::vector<Colour> pixels;

  Raster() = default;
  Raster(int width, int height, Colour fill = {0, 0, 0, 0})
      : width(width), height(height), pixels(static_cast<std::size_t>(width) * height, fill) {}
  Colour& operator()(int column, int row) {
    return pixels[static_cast<std::size_t>(row) * width + column];
  }
};

struct Stroke {
  Colour colour;
  double width = 1;                 ///< [pt]
  std::vector<double> dashes = {};  ///< [pt]; empty: solid
};

enum class Anchor { start, middle, end };
enum class Ground { paper, clear };

/// A drawing in points (1/72 inch), y downwards. It records what is drawn, so that one drawing
/// gives an SVG for the page, a PNG for a README, and a part of a larger drawing.
class Picture {
 public:
  using Points = std::vector<Eigen::Vector2d>;

  Picture(double width, double height);

  double width() const { return width_; }
  double height() const { return height_; }

  void line(const Points& points, const Stroke& stroke);
  void segments(const std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>& segments,
                const Stroke& stroke);
  void polygon(const Points& points, const Colour& fill);
  void outline(const Points& points, const Stroke& stroke);  ///< closed line
  void rectangle(double x, double y, double width, double height, const Colour& fill);
  void circle(const Eigen::Vector2d& centre, double radius, const Stroke& stroke);
  void disc(const Eigen::Vector2d& centre, double radius, const Colour& fill);
  void cross(const Eigen::Vector2d& centre, double radius, const Stroke& stroke);
  /// Baseline at `at`; an optional halo keeps it readable over an image.
  void text(const Eigen::Vector2d& at, const std::string& text, double size, const Colour& colour,
            Anchor anchor = Anchor::start, bool bold = false, bool halo = false);
  void image(const Raster& raster, double x, double y, double width, double height);
  void place(const Picture& other, double x, double y);
  /// Everything drawn until `unclip` shows only inside the rectangle.
  void clip(double x, double y, double width, double height);
  void unclip();

  std::string svg(Ground ground = Ground::paper) const;
  /// Throws std::runtime_error if the file cannot be written.
  void write_png(const std::filesystem::path& path, double pixels_per_point) const;

 private:
  void trace(const Points& points);
  void stroke(const Stroke& stroke);
  void set(const Colour& colour);

  double width_, height_;
  std::shared_ptr<_cairo_surface> surface_;
  std::shared_ptr<_cairo> context_;
};

}  // namespace mammotwin
