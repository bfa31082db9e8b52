#include "pipeline/validation/fit_convergence.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <nlohmann/json.hpp>
#include <numeric>

#include "fitting/slab/skin_patches.h"
#include "fitting/surface/closest_point.h"
#include "fitting/surface/face_mesh.h"
#include "fitting/surface/skin_to_fit.h"
#include "pipeline/report/drawing/palette.h"
#include "pipeline/validation/box_fit.h"
#include "pipeline/validation/chart.h"
#include "pipeline/validation/skin_distance.h"
#include "pipeline/validation/true_skin.h"

namespace mammotwin {
namespace {

constexpr double kStep_mm = 0.5;      // of the true skin's triangles: 0.01 mm off on the nipple
constexpr double kSmoothing = 1e-12;  // the least that the fit takes
constexpr double kShape = 0.1;        // the same
constexpr double kOrder = 4;
constexpr int kLayers = 2;

/// A Gaussian bell on the gel breast's curved chest, in the same frame.
ScannedSkin bell(const ScannedBreast& breast) {
  constexpr double half_side_mm = 85, height_mm = 62, width_mm = 28;
  const int n = static_cast<int>(std::ceil(2 * half_side_mm / kStep_mm));
  ScannedSkin skin;
  for (int j = 0; j <= n; ++j)
    for (int i = 0; i <= n; ++i) {
      const double s = half_side_mm * (2.0 * i / n - 1), t = half_side_mm * (2.0 * j / n - 1);
      const double h = height_mm * std::exp(-(s * s + t * t) / (2 * width_mm * width_mm));
      skin.surface.vertices.push_back(breast.frame_from_file *
                                      Eigen::Vector3d(s, s * s / 800 - h, t));
    }
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      const int v = i + (n + 1) * j;
      skin.surface.triangles.push_back({v, v + 1, v + n + 2});
      skin.surface.triangles.push_back({v, v + n + 2, v + n + 1});
    }
  return skin;
}

/// Root mean square distance [mm] of points to the mesh's skin itself: to triangles inside it, of
/// 1 mm, they are 0.006 mm off on the bell, and that hid what finer meshes gain.
double rms_to_skin(const std::vector<Eigen::Vector3d>& points, const MeshFile& file, int columns) {
  constexpr int per_side = 20;
  const SkinPatches patches(Slab{{columns, columns, kLayers}}, file.mesh);
  const FaceMesh faces = face_mesh(file.mesh, file.faces, FaceLabel::skin, per_side);
  const ClosestPoint closest(faces.surface);
  double sum = 0;
  for (const Eigen::Vector3d& x : points) {
    const MeshPoint near = faces.points[faces.surface.triangles[closest(x).triangle][0]];
    const Eigen::Vector2d start(near.element % columns + near.xi.x(),
                                near.element / columns % columns + near.xi.y());
    sum += (patches.at(patches.nearest(x, start)).x - x).squaredNorm();
  }
  return std::sqrt(sum / static_cast<double>(points.size()));
}

const char* name_of(KnownSkin skin) {
  switch (skin) {
    case KnownSkin::gel_breast:
      return "gel breast";
    case KnownSkin::bell:
      return "smooth bell";
    case KnownSkin::bell_on_box:
      return "smooth bell, distance alone";
  }
  return "";
}

const Colour& colour_of(KnownSkin skin) {
  switch (skin) {
    case KnownSkin::gel_breast:
      return palette::lesion;
    case KnownSkin::bell:
      return palette::nipple;
    case KnownSkin::bell_on_box:
      return palette::ink;
  }
  return palette::lesion;
}

FitAccuracy on_box(int columns) {
  const Slab slab{{columns, columns, 1}};
  std::vector<HermiteMesh::Node> nodes = box_nodes(slab);
  return {KnownSkin::bell_on_box, columns, kBoxSide_mm / columns,
          fit_box(slab, bell_on_box, {}, nodes)};
}

}  // namespace

std::vector<FitAccuracy> fit_convergence(const std::filesystem::path& scan,
                                         const std::vector<int>& columns,
                                         const std::function<void(const std::string&)>& say) {
  const ScannedBreast breast = read_scanned_breast(scan, {});
  std::vector<FitAccuracy> accuracies;
  const auto add = [&](const FitAccuracy& a) {
    accuracies.push_back(a);
    say(std::string(name_of(a.skin)) + ", " + std::to_string(a.columns) +
        " columns: " + std::to_string(a.rms_mm) + " mm");
  };
  for (const int n : columns) add(on_box(n));
  for (const KnownSkin skin : {KnownSkin::gel_breast, KnownSkin::bell}) {
    const ScannedSkin truth = skin == KnownSkin::bell ? bell(breast) : true_skin(breast, kStep_mm);
    const std::vector<Eigen::Vector3d> points =
        scanned_skin_to_fit(truth.surface, breast.segmentation.region).surface.vertices;
    for (const int n : columns) {
      FitOptions options;
      options.elements = Eigen::Vector3i(n, n, kLayers);
      options.smoothing = kSmoothing;
      options.shape = kShape;
      const FitResult fit = fit_breast(breast.segmentation, options, {}, &truth);
      if (!fit.report.usable()) continue;
      const std::vector<double> areas = skin_surface(fit.mesh).vertex_areas();
      const double area = std::accumulate(areas.begin(), areas.end(), 0.0);
      add({skin, n, std::sqrt(area) / n, rms_to_skin(points, fit.mesh, n)});
    }
  }
  return accuracies;
}

nlohmann::json to_json(const std::vector<FitAccuracy>& accuracies) {
  nlohmann::json list = nlohmann::json::array();
  for (const FitAccuracy& a : accuracies)
    list.push_back({{"skin", name_of(a.skin)},
                    {"columns", a.columns},
                    {"element_mm", a.element_mm},
                    {"rms_mm", a.rms_mm}});
  return list;
}

Picture fit_convergence_picture(const std::vector<FitAccuracy>& accuracies) {
  std::map<KnownSkin, Picture::Points> points;
  double lowest = accuracies.front().rms_mm, highest = lowest;
  for (const FitAccuracy& a : accuracies) {
    points[a.skin].emplace_back(a.columns, a.rms_mm);
    lowest = std::min(lowest, a.rms_mm);
    highest = std::max(highest, a.rms_mm);
  }
  Picture::Points expected;  // through the last of the smooth skin
  const Picture::Points& smooth = points.rbegin()->second;
  for (const Eigen::Vector2d& p : smooth)
    expected.emplace_back(p.x(), smooth.back().y() * std::pow(smooth.back().x() / p.x(), kOrder));
  highest = std::max(highest, expected.front().y());
  constexpr double room = 1.3;
  Chart chart({"columns of elements along x and z", smooth.front().x() / 1.1,
               smooth.back().x() * 1.1, true},
              {"skin RMS [mm]", lowest / room, std::pow(room, 13) * highest, true});
  chart.line(expected, palette::third_line, "fourth power of the element size");
  for (const auto& [skin, line] : points) chart.line(line, colour_of(skin), name_of(skin));
  return chart.picture();
}

}  // namespace mammotwin
