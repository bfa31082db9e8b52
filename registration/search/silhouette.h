#pragma once

#include <optional>
#include <vector>

#include "fitting/mesh/mesh_file.h"
#include "registration/search/view_samples.h"
#include "registration/view/detector.h"

namespace mammotwin {

/// Directions from a centre on the detector's edge in which outlines are compared: every 3 degrees,
/// 75 degrees to either side of the depth axis.
inline constexpr int kRays = 51;
Eigen::Vector2d ray_direction(int ray);

/// How far out an outline is met along each ray [mm]; empty where it is not.
using RayDistances = std::vector<std::optional<double>>;

/// Of a line of points, the farthest crossing of each ray.
RayDistances distances_along_rays(const std::vector<Eigen::Vector2d>& line,
                                  const Eigen::Vector2d& centre);

/// The outer faces of a breast as nets of lines, to find its outline on the detector.
class Silhouette {
 public:
  Silhouette(const ReducedView& view, const std::vector<FaceLabels>& faces);

  /// Outline seen from `detector` in a state. Empty, too, where a face met first is none of skin:
  /// there the model ends and the breast goes on.
  RayDistances at(const ReducedView& view, const ViewState& z, const Detector& detector,
                  const Eigen::Vector2d& centre) const;

  void renew(const ReducedView& view) { samples_.renew(view); }

 private:
  struct Line {
    int a, b;
    bool skin;
  };
  std::vector<Line> lines_;
  ViewSamples samples_;
};

}  // namespace mammotwin
