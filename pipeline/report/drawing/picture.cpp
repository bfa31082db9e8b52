#include "pipeline/report/drawing/picture.h"

#include <cairo-svg.h>
#include <cairo.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <regex>
#include <stdexcept>

namespace mammotwin {
namespace {

cairo_status_t append(void* text, const unsigned char* data, unsigned int length) {
  static_cast<std::string*>(text)->append(reinterpret_cast<const char*>(data), length);
  return CAIRO_STATUS_SUCCESS;
}

void replay(cairo_surface_t* recording, cairo_surface_t* target, double scale,
            Ground ground = Ground::paper) {
  cairo_t* context = cairo_create(target);
  if (ground == Ground::paper) {
    cairo_set_source_rgb(context, 1, 1, 1);
    cairo_paint(context);
  }
  cairo_scale(context, scale, scale);
  cairo_set_source_surface(context, recording, 0, 0);
  cairo_paint(context);
  cairo_destroy(context);
}

std::uint32_t premultiplied(const Colour& c) {
  const auto byte = [](double value) {
    return static_cast<std::uint32_t>(std::lround(std::clamp(value, 0.0, 1.0) * 255));
  };
  return byte(c.alpha) << 24 | byte(c.red * c.alpha) << 16 | byte(c.green * c.alpha) << 8 |
         byte(c.blue * c.alpha);
}

}  // namespace

Picture::Picture(double width, double height) : width_(width), height_(height) {
  const cairo_rectangle_t extents = {0, 0, width, height};
  surface_.reset(cairo_recording_surface_create(CAIRO_CONTENT_COLOR_ALPHA, &extents),
                 cairo_surface_destroy);
  context_.reset(cairo_create(surface_.get()), cairo_destroy);
  cairo_set_line_join(context_.get(), CAIRO_LINE_JOIN_ROUND);
  cairo_set_line_cap(context_.get(), CAIRO_LINE_CAP_ROUND);
}

void Picture::set(const Colour& c) {
  cairo_set_source_rgba(context_.get(), c.red, c.green, c.blue, c.alpha);
}

void Picture::trace(const Points& points) {
  cairo_new_path(context_.get());
  for (const Eigen::Vector2d& p : points) cairo_line_to(context_.get(), p.x(), p.y());
}

void Picture::stroke(const Stroke& stroke) {
  set(stroke.colour);
  cairo_set_line_width(context_.get(), stroke.width);
  cairo_set_dash(context_.get(), stroke.dashes.data(), static_cast<int>(stroke.dashes.size()), 0);
  cairo_stroke(context_.get());
}

void Picture::line(const Points& points, const Stroke& style) {
  trace(points);
  stroke(style);
}

void Picture::segments(const std::vector<std::pair<Eigen::Vector2d, Eigen::Vector2d>>& segments,
                       const Stroke& style) {
  cairo_new_path(context_.get());
  for (const auto& [a, b] : segments) {
    cairo_move_to(context_.get(), a.x(), a.y());
    cairo_line_to(context_.get(), b.x(), b.y());
  }
  stroke(style);
}

void Picture::polygon(const Points& points, const Colour& fill) {
  trace(points);
  cairo_close_path(context_.get());
  set(fill);
  cairo_fill(context_.get());
}

void Picture::outline(const Points& points, const Stroke& style) {
  trace(points);
  cairo_close_path(context_.get());
  stroke(style);
}

void Picture::rectangle(double x, double y, double width, double height, const Colour& fill) {
  polygon({{x, y}, {x + width, y}, {x + width, y + height}, {x, y + height}}, fill);
}

void Picture::circle(const Eigen::Vector2d& centre, double radius, const Stroke& style) {
  cairo_new_path(context_.get());
  cairo_arc(context_.get(), centre.x(), centre.y(), radius, 0, 2 * std::numbers::pi);
  stroke(style);
}

void Picture::disc(const Eigen::Vector2d& centre, double radius, const Colour& fill) {
  cairo_new_path(context_.get());
  cairo_arc(context_.get(), centre.x(), centre.y(), radius, 0, 2 * std::numbers::pi);
  set(fill);
  cairo_fill(context_.get());
}

void Picture::cross(const Eigen::Vector2d& c, double r, const Stroke& style) {
  line({{c.x() - r, c.y() - r}, {c.x() + r, c.y() + r}}, style);
  line({{c.x() - r, c.y() + r}, {c.x() + r, c.y() - r}}, style);
}

void Picture::text(const Eigen::Vector2d& at, const std::string& text, double size,
                   const Colour& colour, Anchor anchor, bool bold, bool halo) {
  cairo_t* c = context_.get();
  cairo_select_font_face(c, "sans-serif", CAIRO_FONT_SLANT_NORMAL,
                         bold ? CAIRO_FONT_WEIGHT_BOLD : CAIRO_FONT_WEIGHT_NORMAL);
  cairo_set_font_size(c, size);
  cairo_text_extents_t extents;
  cairo_text_extents(c, text.c_str(), &extents);
  const double shift = anchor == Anchor::start ? 0 : anchor == Anchor::middle ? 0.5 : 1;
  cairo_new_path(c);
  cairo_move_to(c, at.x() - shift * extents.x_advance, at.y());
  cairo_text_path(c, text.c_str());
  if (halo) {
    set({0, 0, 0, 0.75});
    cairo_set_dash(c, nullptr, 0, 0);
    cairo_set_line_width(c, size / 4);
    cairo_stroke_preserve(c);
  }
  set(colour);
  cairo_fill(c);
}

void Picture::image(const Raster& raster, double x, double y, double width, double height) {
  cairo_surface_t* pixels =
      cairo_image_surface_create(CAIRO_FORMAT_ARGB32, raster.width, raster.height);
  unsigned char* data = cairo_image_surface_get_data(pixels);
  const int stride = cairo_image_surface_get_stride(pixels);
  for (int row = 0; row < raster.height; ++row)
    for (int column = 0; column < raster.width; ++column)
      reinterpret_cast<std::uint32_t*>(data + row * stride)[column] =
          premultiplied(raster.pixels[static_cast<std::size_t>(row) * raster.width + column]);
  cairo_surface_mark_dirty(pixels);
  cairo_t* c = context_.get();
  cairo_save(c);
  cairo_translate(c, x, y);
  cairo_scale(c, width / raster.width, height / raster.height);
  cairo_set_source_surface(c, pixels, 0, 0);
  cairo_pattern_set_filter(cairo_get_source(c), CAIRO_FILTER_BILINEAR);
  cairo_pattern_set_extend(cairo_get_source(c), CAIRO_EXTEND_PAD);
  cairo_rectangle(c, 0, 0, raster.width, raster.height);
  cairo_fill(c);
  cairo_restore(c);
  cairo_surface_destroy(pixels);
}

void Picture::place(const Picture& other, double x, double y) {
  cairo_save(context_.get());
  cairo_translate(context_.get(), x, y);
  cairo_set_source_surface(context_.get(), other.surface_.get(), 0, 0);
  cairo_paint(context_.get());
  cairo_restore(context_.get());
}

void Picture::clip(double x, double y, double width, double height) {
  cairo_save(context_.get());
  cairo_rectangle(context_.get(), x, y, width, height);
  cairo_clip(context_.get());
}

void Picture::unclip() { cairo_restore(context_.get()); }

namespace {

/// Cairo numbers the parts of an SVG through the whole process; numbered from 1 in each picture,
/// the same drawing gives the same bytes.
std::string with_own_numbers(const std::string& svg) {
  static const std::regex part("((?:id=\"|url\\(#|href=\"#)[a-z]+)([0-9]+)");
  std::map<std::string, int> numbers;
  std::string result;
  std::size_t done = 0;
  for (std::sregex_iterator i(svg.begin(), svg.end(), part), end; i != end; ++i) {
    const int number =
        numbers.emplace((*i)[2].str(), static_cast<int>(numbers.size()) + 1).first->second;
    result.append(svg, done, i->position() - done);
    result += (*i)[1].str() + std::to_string(number);
    done = i->position() + i->length();
  }
  return result.append(svg, done, std::string::npos);
}

}  // namespace

std::string Picture::svg(Ground ground) const {
  std::string text;
  cairo_surface_t* target = cairo_svg_surface_create_for_stream(append, &text, width_, height_);
  replay(surface_.get(), target, 1, ground);
  cairo_surface_finish(target);
  cairo_surface_destroy(target);
  return with_own_numbers(text);
}

void Picture::write_png(const std::filesystem::path& path, double pixels_per_point) const {
  cairo_surface_t* target = cairo_image_surface_create(
      CAIRO_FORMAT_RGB24, static_cast<int>(std::ceil(width_ * pixels_per_point)),
      static_cast<int>(std::ceil(height_ * pixels_per_point)));
  replay(surface_.get(), target, pixels_per_point);
  const cairo_status_t status = cairo_surface_write_to_png(target, path.c_str());
  cairo_surface_destroy(target);
  if (status != CAIRO_STATUS_SUCCESS)
    throw std::runtime_error(path.string() +
                             ": cannot be written: " + cairo_status_to_string(status));
}

}  // namespace mammotwin
