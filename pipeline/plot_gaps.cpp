// plot-gaps: compressed meshes -> how flat their skin lies under each plate, as a picture.

#include <algorithm>
#include <fstream>
#include <nlohmann/json.hpp>

#include "pipeline/frame/command_line.h"
#include "pipeline/report/drawing/depth_image.h"
#include "pipeline/report/drawing/mesh_surface.h"
#include "pipeline/report/drawing/palette.h"
#include "pipeline/report/word.h"
#include "pipeline/steps/solution_record.h"
#include "registration/view/compressed_view.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

constexpr int kSamples = 24;     // squares a side of an element's face
constexpr double kEnd_mm = 0.5;  // where the colours end
constexpr double kOff_mm = 2;    // farther off, skin is under no plate
// Deeper, it is behind a plate's rounded rear edge: no solve lets skin come in so far.
constexpr double kBehind_mm = -0.6;
constexpr double kTouching_mm = 0.1;  // as the stage's contact area has it
constexpr double kMargin_mm = 10;     // around what is drawn
constexpr double kPointsPerMm = 2;
constexpr double kPixelsPerPoint = 1.5;
constexpr double kTitle = 46, kLegend = 40;  // [pt]

struct Arguments {
  fs::path picture;
  std::vector<std::string> compressed;
};

void declare(CommandLine& command, Arguments& args) {
  command.option("picture", args.picture, "picture to write (.png)").required();
  command.option("compressed", args.compressed, "one or more compressed meshes (.vtu): a row each")
      .required();
}

bool is_under(double gap_mm) { return gap_mm > kBehind_mm && gap_mm < kOff_mm; }

/// Skin as one plate sees it: lateral to the right, depth upwards, towards the plate.
struct SkinUnderPlate {
  std::string name;
  FaceTriangles skin;
  std::vector<double> gaps;  ///< of its points [mm], negative inside

  double gap(std::size_t triangle) const {
    const auto& [a, b, c] = skin.triangles[triangle];
    return (gaps[a] + gaps[b] + gaps[c]) / 3;
  }

  double area_within_cm2(double mm) const {
    double area = 0;
    for (std::size_t t = 0; t < skin.triangles.size(); ++t) {
      const auto& [a, b, c] = skin.triangles[t];
      const Eigen::Vector3d across =
          (skin.points[b] - skin.points[a]).cross(skin.points[c] - skin.points[a]);
      if (is_under(gap(t)) && gap(t) < mm) area += across.norm() / 2;
    }
    return area / 100;
  }

  Eigen::AlignedBox2d window() const {
    Eigen::AlignedBox2d window;
    for (std::size_t i = 0; i < gaps.size(); ++i)
      if (is_under(gaps[i])) window.extend(skin.points[i].head<2>().eval());
    return window;
  }
};

struct PressedSkin {
  std::string title;
  SkinUnderPlate paddle{"paddle", {}, {}}, support{"support", {}, {}};
};

std::string percentile_in(const fs::path& sidecar) {
  std::ifstream file(sidecar);
  if (!file) return "";
  const auto quality = nlohmann::json::parse(file).at("quality");
  if (!quality.contains("gap_p95_mm")) return "";
  return ", " + word::number(quality.at("gap_p95_mm"), 2) +
         " mm at most off where they press, at 95 % of the area";
}

PressedSkin read_pressed(const fs::path& path) {
  const MeshFile file = read_mesh_file(path);
  const CompressedView view = compressed_view(path.stem(), path.string(), file.metadata);
  const std::optional<SolutionRecord> solution = read_solution(file, path.string());
  if (!solution) throw std::runtime_error(path.string() + ": no plates; expected compress's mesh");
  const double apart = solution->paddle_height_mm - solution->support_height_mm;
  PressedSkin pressed;
  pressed.title = path.parent_path().filename().string() + ", " + view.name + ", " +
                  word::number(apart, 1) + " mm between the plates" +
                  percentile_in(path.string() + ".json");
  pressed.paddle.skin = triangulate(file.mesh, skin_faces(file), kSamples);
  for (Eigen::Vector3d& x : pressed.paddle.skin.points) {
    x = view.frame.view_from_lps(x);
    std::swap(x.x(), x.y());
  }
  pressed.support.skin = pressed.paddle.skin;
  for (Eigen::Vector3d& x : pressed.paddle.skin.points)
    pressed.paddle.gaps.push_back(apart - x.z());
  for (Eigen::Vector3d& x : pressed.support.skin.points) {
    pressed.support.gaps.push_back(x.z());
    x.z() = -x.z();
  }
  return pressed;
}

/// Blue inside the plate, red off it, grey where no plate presses.
Colour gap_colour(double mm) {
  return is_under(mm) ? palette::inside_outside(mm / kEnd_mm) : palette::grid;
}

void draw(const SkinUnderPlate& seen, const Eigen::AlignedBox2d& window, double x, double y,
          Picture& picture) {
  const Eigen::Vector2d size = window.sizes() * kPointsPerMm;
  DepthImage image(static_cast<int>(size.x() * kPixelsPerPoint),
                   static_cast<int>(size.y() * kPixelsPerPoint), window.min(),
                   1 / (kPointsPerMm * kPixelsPerPoint));
  for (std::size_t t = 0; t < seen.skin.triangles.size(); ++t) {
    const auto& [a, b, c] = seen.skin.triangles[t];
    image.triangle({seen.skin.points[a], seen.skin.points[b], seen.skin.points[c]},
                   gap_colour(seen.gap(t)));
  }
  picture.image(image.raster(), x, y, size.x(), size.y());
  picture.text({x + 6, y - 6},
               seen.name + ": " + word::number(seen.area_within_cm2(kTouching_mm), 0) +
                   " cm² within 0.1 mm of it, " + word::number(seen.area_within_cm2(1), 0) +
                   " within 1 mm",
               9, palette::ink);
}

void draw_legend(Picture& picture, double y) {
  constexpr int steps = 60;
  constexpr double width = 240, x = 12;
  for (int n = 0; n < steps; ++n)
    picture.rectangle(x + width * n / steps, y, width / steps + 0.5, 9,
                      gap_colour(kEnd_mm * (2.0 * n / (steps - 1) - 1)));
  picture.text({x, y + 21}, "inside by 0.5 mm", 9, palette::quiet);
  picture.text({x + width / 2, y + 21}, "0", 9, palette::quiet, Anchor::middle);
  picture.text({x + width, y + 21}, "0.5 to 2 mm off", 9, palette::quiet, Anchor::end);
}

int run(const Arguments& args) {
  std::vector<PressedSkin> rows;
  Eigen::AlignedBox2d window;
  for (const fs::path path : args.compressed) {
    rows.push_back(read_pressed(path));
    window.extend(rows.back().paddle.window());
    window.extend(rows.back().support.window());
  }
  if (window.isEmpty()) throw std::runtime_error("no skin lies within 2 mm of a plate");
  window = {window.min().array() - kMargin_mm, window.max().array() + kMargin_mm};
  const Eigen::Vector2d size = window.sizes() * kPointsPerMm;
  Picture picture(2 * size.x(), (kTitle + size.y()) * static_cast<double>(rows.size()) + kLegend);
  picture.rectangle(0, 0, picture.width(), picture.height(), palette::paper);
  double y = 0;
  for (const PressedSkin& row : rows) {
    picture.text({6, y + 22}, row.title, 11, palette::ink, Anchor::start, true);
    draw(row.paddle, window, 0, y + kTitle, picture);
    draw(row.support, window, size.x(), y + kTitle, picture);
    y += kTitle + size.y();
  }
  draw_legend(picture, y + 8);
  picture.write_png(args.picture, kPixelsPerPoint);
  return 0;
}

}  // namespace
}  // namespace mammotwin

int main(int argc, char** argv) {
  using namespace mammotwin;
  return run_plain_command<Arguments>(argc, argv, "plot-gaps",
                                      "Draws how flat compressed breasts lie under each plate",
                                      declare, run);
}
