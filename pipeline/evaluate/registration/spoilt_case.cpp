#include "pipeline/evaluate/registration/spoilt_case.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <sstream>
#include <stdexcept>

#include "pipeline/frame/products.h"
#include "registration/export/png_file.h"
#include "registration/mammogram/mammogram_findings.h"
#include "registration/mammogram/mammogram_picture.h"
#include "registration/mammogram/nipple_marker.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

constexpr double kSpoiltPixel_mm = 0.25;  // of the synthetic detector

/// Greys of a disc become as smooth as its border allows (Laplace's equation, relaxed).
void smooth_over(MammogramImage& image, const Eigen::Vector2d& centre, double radius) {
  constexpr int kRounds = 400;  // the disc is 20 pixels across
  for (int round = 0; round < kRounds; ++round)
    for (int row = static_cast<int>(centre.y() - radius); row <= centre.y() + radius; ++row)
      for (int c = static_cast<int>(centre.x() - radius); c <= centre.x() + radius; ++c)
        if ((Eigen::Vector2d(c, row) - centre).norm() <= radius && c > 0 && row > 0 &&
            c + 1 < image.columns && row + 1 < image.rows)
          image.at(c, row) = (image.at(c - 1, row) + image.at(c + 1, row) + image.at(c, row - 1) +
                              image.at(c, row + 1)) /
                             4;
}

void take_marker_away(const fs::path& path) {
  constexpr double kRadius_mm = 2.5;  // the marker's is 1.75
  MammogramImage image = read_mammogram_picture(path);
  const auto marker = find_marker(image, kSpoiltPixel_mm);
  if (!marker) throw std::runtime_error(path.string() + ": shows no marker to take away");
  smooth_over(image, *marker, kRadius_mm / kSpoiltPixel_mm);
  write_grey(path, image);
}

/// Columns of 10 mm from the chest wall, over all rows.
std::string muscle_line(const fs::path& mammogram) {
  constexpr double kMuscle_mm = 10;
  const MammogramImage image = read_mammogram_picture(mammogram);
  const MammogramFindings found = find_breast(image, kSpoiltPixel_mm, true);
  const double from_wall = kMuscle_mm / kSpoiltPixel_mm;
  const double column =
      found.chest_wall == ImageEdge::left ? from_wall : image.columns - 1 - from_wall;
  std::ostringstream line;
  line << "pectoral = [[" << column << ", 0], [" << column << ", " << image.rows - 1 << "]]\n";
  return line.str();
}

void say_muscle(const fs::path& folder) {
  std::ifstream in(folder / "patient.toml");
  std::ostringstream text;
  text << in.rdbuf();
  std::string toml = text.str();
  const std::string view = "[views.mlo]\n";
  const auto at = toml.find(view);
  if (at == std::string::npos) throw std::runtime_error("patient.toml has no [views.mlo]");
  toml.insert(at + view.size(), muscle_line(folder / "mlo.png"));
  write_text_atomically(folder / "patient.toml", toml);
}

}  // namespace

void copy_case(const fs::path& made, const fs::path& folder) {
  fs::create_directories(folder);
  for (const auto& entry : fs::directory_iterator(made))
    if (entry.is_regular_file())
      fs::copy_file(entry.path(), folder / entry.path().filename(),
                    fs::copy_options::overwrite_existing);
}

void write_grey(const fs::path& path, const MammogramImage& image) {
  GreyPixels pixels{image.columns, image.rows, {}};
  for (const float grey : image.grey)
    pixels.grey.push_back(static_cast<std::uint16_t>(std::lround(grey)));
  write_png(path, pixels);
}

void add_abdomen(const fs::path& path) {
  constexpr double kDepth_mm = 35, kHalfHeight_mm = 26, kBelow_mm = 20, kGrey = 20000;
  MammogramImage image = read_mammogram_picture(path);
  const MammogramFindings found = find_breast(image, kSpoiltPixel_mm, true);
  const double middle = found.outline.back().y() + kBelow_mm / kSpoiltPixel_mm;
  for (int row = 0; row < image.rows; ++row)
    for (int column = 0; column < image.columns; ++column) {
      const int from_wall =
          found.chest_wall == ImageEdge::left ? column : image.columns - 1 - column;
      const double rho = std::hypot(from_wall * kSpoiltPixel_mm / kDepth_mm,
                                    (row - middle) * kSpoiltPixel_mm / kHalfHeight_mm);
      if (rho >= 1) continue;
      const float grey = static_cast<float>(kGrey * std::sqrt(1 - rho * rho));
      image.at(column, row) = std::max(image.at(column, row), grey);
    }
  write_grey(path, image);
}

void add_skin_fold(const fs::path& path, bool oblique) {
  constexpr double kAlong = 0.25, kLength_mm = 40, kHalfWidth_mm = 2, kGrey = 8000;
  MammogramImage image = read_mammogram_picture(path);
  const MammogramFindings found = find_breast(image, kSpoiltPixel_mm, oblique);
  const Eigen::Vector2d begin = found.outline[std::lround(kAlong * (found.outline.size() - 1))];
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& x : found.outline) middle += x / found.outline.size();
  const Eigen::Vector2d way = (middle - begin).normalized();
  for (int row = 0; row < image.rows; ++row)
    for (int column = 0; column < image.columns; ++column) {
      const Eigen::Vector2d x = Eigen::Vector2d(column, row) - begin;
      const double along = way.dot(x) * kSpoiltPixel_mm / kLength_mm;
      const double across = (x - way.dot(x) * way).norm() * kSpoiltPixel_mm / kHalfWidth_mm;
      if (along < 0 || along > 1) continue;
      const double grey = image.at(column, row) + kGrey * (1 - along) * std::exp(-across * across);
      image.at(column, row) = static_cast<float>(std::min(grey, 65535.));
    }
  write_grey(path, image);
}

void spoil_registration_case(const fs::path& made, const std::string& spoil,
                             const fs::path& folder) {
  if (fs::exists(folder / "patient.toml")) return;
  copy_case(made, folder);
  if (spoil == "abdomen") return add_abdomen(folder / "mlo.png");
  if (spoil == "pectoral") return say_muscle(folder);
  for (const char* view : {"cc.png", "mlo.png"}) take_marker_away(folder / view);
}

}  // namespace mammotwin
