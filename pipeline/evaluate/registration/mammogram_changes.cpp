#include "pipeline/evaluate/registration/mammogram_changes.h"

#include <algorithm>
#include <cmath>

#include "pipeline/evaluate/registration/line_distance.h"
#include "pipeline/synthesize/counter_random.h"

namespace mammotwin {
namespace {

using nlohmann::json;
using Point = Eigen::Vector2d;

float darkest(const MammogramImage& image) {
  return *std::min_element(image.grey.begin(), image.grey.end());
}

float brightest(const MammogramImage& image) {
  return *std::max_element(image.grey.begin(), image.grey.end());
}

ChangedMammogram unmoved(const MammogramImage& image, double pixel_mm) {
  return {image, pixel_mm, [](const Point& x) { return x; }};
}

float bilinear(const MammogramImage& image, const Point& x, float outside) {
  const int c = static_cast<int>(std::floor(x.x())), r = static_cast<int>(std::floor(x.y()));
  if (c < -1 || r < -1 || c >= image.columns || r >= image.rows) return outside;
  const float a = static_cast<float>(x.x() - c), b = static_cast<float>(x.y() - r);
  const auto at = [&](int column, int row) {
    return image.at(std::clamp(column, 0, image.columns - 1), std::clamp(row, 0, image.rows - 1));
  };
  return (1 - b) * ((1 - a) * at(c, r) + a * at(c + 1, r)) +
         b * ((1 - a) * at(c, r + 1) + a * at(c + 1, r + 1));
}

/// Means over boxes of a pixel's size: resampled to larger pixels noise falls, as in a detector.
ChangedMammogram resampled(const MammogramImage& image, double from_mm, double to_mm) {
  const double step = to_mm / from_mm;
  const int parts = std::max(1, static_cast<int>(std::ceil(step)));
  MammogramImage to{
      static_cast<int>(image.columns / step), static_cast<int>(image.rows / step), {}};
  for (int row = 0; row < to.rows; ++row)
    for (int column = 0; column < to.columns; ++column) {
      float sum = 0;
      for (int i = 0; i < parts; ++i)
        for (int j = 0; j < parts; ++j)
          sum += bilinear(
              image,
              {(column + (i + 0.5) / parts) * step - 0.5, (row + (j + 0.5) / parts) * step - 0.5},
              0);
      to.grey.push_back(std::round(sum / (parts * parts)));
    }
  return {std::move(to), to_mm, [step](const Point& x) -> Point {
            return (x + Point(0.5, 0.5)) / step - Point(0.5, 0.5);
          }};
}

ChangedMammogram mirrored(const MammogramImage& image, double pixel_mm) {
  ChangedMammogram changed = unmoved(image, pixel_mm);
  changed.image = mirror_image(std::move(changed.image));
  const double last = image.columns - 1;
  changed.changed_from_first = [last](const Point& x) { return Point(last - x.x(), x.y()); };
  return changed;
}

/// Of 16 greys for each, with noise between them: 8 bits as 12.
ChangedMammogram in_12_bits(const MammogramImage& image, double pixel_mm) {
  constexpr double kGreys = 16;
  ChangedMammogram changed = unmoved(image, pixel_mm);
  CounterRandom random(26, 12);
  for (float& grey : changed.image.grey)
    grey = static_cast<float>(std::floor(kGreys * (grey + random.uniform(0, 1))));
  return changed;
}

/// Other greys for the same image, rounded as exports are; `curve` maps 0..1 to 0..1.
ChangedMammogram shown_by(const MammogramImage& image, double pixel_mm,
                          const std::function<double(double)>& curve) {
  constexpr double kWhite = 255;
  ChangedMammogram changed = unmoved(image, pixel_mm);
  const float low = darkest(image), range = std::max(1e-6f, brightest(image) - low);
  for (float& grey : changed.image.grey)
    grey = static_cast<float>(std::round(kWhite * curve((grey - low) / range)));
  return changed;
}

/// About the middle of the image's chest-wall edge; columns that the turn leaves empty at that edge
/// are cut off, and elsewhere the nearest pixel goes on: an image has no slanted black border.
ChangedMammogram turned(const MammogramImage& image, double pixel_mm, ImageEdge wall, double deg) {
  const double angle = deg * M_PI / 180;
  const Eigen::Matrix2d turn = Eigen::Rotation2Dd(angle).toRotationMatrix();
  const Point middle(wall == ImageEdge::left ? 0 : image.columns - 1, (image.rows - 1) / 2.);
  const int cut = static_cast<int>(std::ceil(std::abs(std::sin(angle)) * image.rows / 2));
  const int first = wall == ImageEdge::left ? cut : 0;
  const Point last(image.columns - 1, image.rows - 1);
  MammogramImage to{image.columns - cut, image.rows, {}};
  for (int row = 0; row < to.rows; ++row)
    for (int column = 0; column < to.columns; ++column) {
      const Point from = middle + turn.transpose() * (Point(column + first, row) - middle);
      to.grey.push_back(std::round(bilinear(image, from.cwiseMax(0).cwiseMin(last), 0)));
    }
  return {std::move(to), pixel_mm,
          [=](const Point& x) -> Point { return middle + turn * (x - middle) - Point(first, 0); }};
}

ChangedMammogram cropped(const MammogramImage& image, double pixel_mm, double top_mm,
                         double bottom_mm) {
  const int top = std::lround(top_mm / pixel_mm), bottom = std::lround(bottom_mm / pixel_mm);
  MammogramImage to{image.columns, image.rows - top - bottom, {}};
  const auto begin = image.grey.begin() + static_cast<std::ptrdiff_t>(top) * image.columns;
  to.grey.assign(begin, begin + static_cast<std::ptrdiff_t>(to.rows) * to.columns);
  return {std::move(to), pixel_mm, [top](const Point& x) { return Point(x.x(), x.y() - top); }};
}

ChangedMammogram bordered(const MammogramImage& image, double pixel_mm) {
  static constexpr int kWide = 4;
  const float white = brightest(image);
  MammogramImage to{image.columns + 2 * kWide, image.rows + 2 * kWide, {}};
  to.grey.assign(static_cast<std::size_t>(to.columns) * to.rows, white);
  for (int row = 0; row < image.rows; ++row)
    for (int column = 0; column < image.columns; ++column)
      to.at(column + kWide, row + kWide) = image.at(column, row);
  return {std::move(to), pixel_mm, [](const Point& x) -> Point { return x + Point(kWide, kWide); }};
}

/// Letters of 4 by 8 mm in the darker of the corners away from the chest wall.
ChangedMammogram lettered(const MammogramImage& image, double pixel_mm, ImageEdge wall) {
  constexpr double kFrom_mm = 8, kWide_mm = 22, kHigh_mm = 8, kPitch_mm = 6, kStroke_mm = 1;
  ChangedMammogram changed = unmoved(image, pixel_mm);
  MammogramImage& to = changed.image;
  const float white = brightest(image);
  const auto place = [&](double in_mm, double down_mm, bool top) -> float& {
    const int in = static_cast<int>(in_mm / pixel_mm), down = static_cast<int>(down_mm / pixel_mm);
    return to.at(wall == ImageEdge::left ? to.columns - 1 - in : in,
                 top ? down : to.rows - 1 - down);
  };
  const auto over_letters = [&](const auto& see) {
    for (double x = 0; x < kWide_mm; x += pixel_mm)
      for (double y = 0; y < kHigh_mm; y += pixel_mm) see(x, y);
  };
  double sums[2] = {0, 0};
  for (const bool top : {false, true})
    over_letters([&](double x, double y) { sums[top] += place(kFrom_mm + x, kFrom_mm + y, top); });
  const bool top = sums[1] < sums[0];
  over_letters([&](double x, double y) {
    const double in_letter = std::fmod(x, kPitch_mm);
    const bool upright = in_letter < kStroke_mm, bar = y < kStroke_mm && in_letter < 4;
    if (upright || bar) place(kFrom_mm + x, kFrom_mm + y, top) = white;
  });
  return changed;
}

/// 95 % of a line's points, but for `ends_mm` at both its ends, are no farther from another line,
/// which goes on straight beyond its own.
double moved_by(const std::vector<Point>& line, const std::vector<Point>& other, double pixel_mm,
                double ends_mm) {
  constexpr double kShare = 0.95;
  std::vector<double> distances;
  for (const Point& x : line) {
    if ((x - line.front()).norm() * pixel_mm < ends_mm ||
        (x - line.back()).norm() * pixel_mm < ends_mm)
      continue;
    distances.push_back(distance_to_line(x, other, true) * pixel_mm);
  }
  if (distances.empty()) return 0;
  const auto at = distances.begin() + static_cast<std::ptrdiff_t>(kShare * (distances.size() - 1));
  std::nth_element(distances.begin(), at, distances.end());
  return *at;
}

bool shows(const MammogramImage& image, const Point& x) {
  return x.x() >= 0 && x.y() >= 0 && x.x() < image.columns && x.y() < image.rows;
}

bool says(const std::vector<std::string>& unsure, const char* what) {
  return std::find(unsure.begin(), unsure.end(), what) != unsure.end();
}

}  // namespace

MammogramImage mirror_image(MammogramImage image) {
  for (int row = 0; row < image.rows; ++row) {
    const auto begin = image.grey.begin() + static_cast<std::ptrdiff_t>(row) * image.columns;
    std::reverse(begin, begin + image.columns);
  }
  return image;
}

MammogramImage upside_down(MammogramImage image) {
  std::reverse(image.grey.begin(), image.grey.end());
  return mirror_image(std::move(image));
}

std::vector<MammogramChange> mammogram_changes() {
  using Image = const MammogramImage&;
  const auto resample = [](double to_mm) {
    return [to_mm](Image i, double mm, ImageEdge) { return resampled(i, mm, to_mm); };
  };
  const auto show = [](const std::function<double(double)>& curve) {
    return [curve](Image i, double mm, ImageEdge) { return shown_by(i, mm, curve); };
  };
  const auto turn = [](double deg) {
    return [deg](Image i, double mm, ImageEdge wall) { return turned(i, mm, wall, deg); };
  };
  const auto crop = [](double top_mm, double bottom_mm) {
    return [=](Image i, double mm, ImageEdge) { return cropped(i, mm, top_mm, bottom_mm); };
  };
  return {{"mirrored", [](Image i, double mm, ImageEdge) { return mirrored(i, mm); }},
          {"pixels of 0.05 mm", resample(0.05)},
          {"pixels of 0.07 mm", resample(0.07)},
          {"pixels of 0.2 mm", resample(0.2)},
          {"12 bits", [](Image i, double mm, ImageEdge) { return in_12_bits(i, mm); }},
          {"half as bright", show([](double g) { return 0.1 + 0.5 * g; })},
          {"gamma 0.8", show([](double g) { return std::pow(g, 0.8); })},
          {"gamma 1.25", show([](double g) { return std::pow(g, 1.25); })},
          {"turned by 5 degrees", turn(5)},
          {"turned by -5 degrees", turn(-5)},
          {"2 mm less at top and bottom", crop(2, 2)},
          {"white border", [](Image i, double mm, ImageEdge) { return bordered(i, mm); }},
          {"letters", [](Image i, double mm, ImageEdge wall) { return lettered(i, mm, wall); }}};
}

json change_row(const MammogramFindings& first, const MammogramFindings& after,
                const ChangedMammogram& changed) {
  constexpr double kOutline_mm = 3, kEnds_mm = 15;  // where skin is left is a matter of taste
  const auto moved = [&](const std::vector<Point>& line) {
    std::vector<Point> to;
    for (const Point& x : line) to.push_back(changed.changed_from_first(x));
    return to;
  };
  const auto seen = [&](std::vector<Point> line) {
    std::erase_if(line, [&](const Point& x) { return !shows(changed.image, x); });
    return line;
  };
  const auto sure = [&](const char* what) {
    return !says(first.unsure, what) && !says(after.unsure, what);
  };
  json row{{"nipple_sd_mm", first.nipple_sd_mm},
           {"nipple_sd_after_mm", after.nipple_sd_mm},
           {"pectoral_mm", nullptr},
           {"unsure", first.unsure},
           {"unsure_after", after.unsure},
           {"moved", json::array()}};
  const double outline = moved_by(moved(first.outline), after.outline, changed.pixel_mm, kEnds_mm);
  const double nipple =
      (changed.changed_from_first(first.nipple) - after.nipple).norm() * changed.pixel_mm;
  row["outline_p95_mm"] = outline;
  row["nipple_mm"] = nipple;
  if (sure("outline") && outline > kOutline_mm) row["moved"].push_back("outline");
  if (sure("nipple") && nipple > std::min(first.nipple_sd_mm, after.nipple_sd_mm))
    row["moved"].push_back("nipple");
  row["held"] = row["moved"].empty();
  if (!first.pectoral || !after.pectoral) return row;
  const double pectoral = moved_by(seen(moved(first.pectoral_curve)), coarse(after.pectoral_curve),
                                   changed.pixel_mm, 0);
  row["pectoral_mm"] = pectoral;
  row["pectoral_sd_mm"] = first.pectoral_sd_mm;
  row["pectoral_sd_after_mm"] = after.pectoral_sd_mm;
  if (sure("pectoral") && pectoral > std::min(first.pectoral_sd_mm, after.pectoral_sd_mm))
    row["moved"].push_back("pectoral");
  row["held"] = row["moved"].empty();
  return row;
}

}  // namespace mammotwin
