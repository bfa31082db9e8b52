#include "pipeline/report/live/what_if_data.h"

#include <algorithm>
#include <map>

#include "pipeline/report/drawing/lesion_outline.h"
#include "pipeline/report/live/base64.h"
#include "pipeline/report/quality_limit.h"
#include "pipeline/report/word.h"
#include "registration/carry/ray_curve.h"
#include "registration/search/silhouette.h"
#include "registration/search/what_if.h"

namespace mammotwin {
namespace {

using nlohmann::json;

/// Slopes a standard deviation of every mechanical number; empty without effect.
Slopes slopes_of(const ViewResult& view) {
  Slopes slopes;
  const Nodes base = in_view(view.file.mesh.nodes(), view.view.frame);
  for (int i = 0; i < kMechanical; ++i)
    if (const Nodes& varied = view.uncertainty->varied[i]; !varied.empty())
      slopes[i] = combined(1, in_view(varied, view.view.frame), -1, base);
  return slopes;
}

/// Material points in the view's frame, each with its slopes a standard deviation along every
/// mechanical number and, for each of kWhatIf, slope and curvature by the number's range.
class TrackedPoints {
 public:
  TrackedPoints(const ReducedView& what_if, const Slopes& slopes)
      : what_if_(what_if), slopes_(slopes) {}

  /// Its number. `x` [mm, view frame] is where it stands; at `point` or beside it.
  int add(const Eigen::Vector3d& x, const MeshPoint& point) {
    append(x);
    for (const Nodes& slope : slopes_) append(slope, point);
    for (const WhatIf& varied : kWhatIf) {
      const ReducedView::Mode& mode = what_if_.modes[varied.number];
      append(mode.linear, point);
      append(mode.quadratic, point);
    }
    return count_++;
  }

  std::string packed() const { return base64(numbers_.data(), numbers_.size() * sizeof(float)); }

 private:
  void append(const Eigen::Vector3d& x) {
    for (const double number : x) numbers_.push_back(static_cast<float>(number));
  }
  void append(const Nodes& change, const MeshPoint& point) {
    append(change.empty() ? Eigen::Vector3d::Zero().eval()
                          : HermiteMesh(change, what_if_.elements).position(point));
  }

  const ReducedView& what_if_;
  const Slopes& slopes_;
  std::vector<float> numbers_;
  int count_ = 0;
};

/// Ends of the outline's pieces, as numbers of points at the lesion's height.
json outline_of(const PatientResults& results, std::size_t lesion, const ProjectedLandmark& place,
                const ViewProjection& projection, const ViewRays& rays, TrackedPoints& points) {
  json ends = json::array();
  if (!results.segmentation) return ends;
  std::map<std::pair<double, double>, int> known;
  for (const auto& piece :
       lesion_outline(results.segmentation->labels,
                      static_cast<std::uint8_t>(label::lesion + lesion), projection))
    for (const Eigen::Vector2d& uv : {piece.first, piece.second}) {
      const auto [found, is_new] = known.try_emplace({uv.x(), uv.y()}, 0);
      if (is_new) {
        const auto tissue = rays.at_height(uv, place.in_view.z());
        found->second = points.add(projection.detector().point_on_ray(uv, place.in_view.z()),
                                   tissue ? tissue->point : place.point);
      }
      ends.push_back(found->second);
    }
  return ends;
}

/// Distances of the skin's outline from the middle of the detector's edge: as it is, and by slope
/// and curvature of each of kWhatIf over its range; null where the model has no skin.
json skin_data(const ReducedView& what_if, const ViewResult& view) {
  const Silhouette silhouette(what_if, view.file.faces);
  const auto at = [&](const ViewState& z) {
    return silhouette.at(what_if, z, view.detector, Eigen::Vector2d::Zero());
  };
  const RayDistances here = at(ViewState::Zero());
  json rays = json::array();
  for (int ray = 0; ray < kRays; ++ray) {
    const Eigen::Vector2d d = ray_direction(ray);
    rays.push_back({{"direction", {d.x(), d.y()}},
                    {"far", here[ray] ? json(*here[ray]) : json()},
                    {"slopes", json::array()},
                    {"curvatures", json::array()}});
  }
  for (const WhatIf& varied : kWhatIf) {
    const ViewState end = ViewState::Unit(varied.number);
    const RayDistances up = at(end), down = at(-end);
    for (int ray = 0; ray < kRays; ++ray) {
      const bool all = here[ray] && up[ray] && down[ray];
      rays[ray]["slopes"].push_back(all ? (*up[ray] - *down[ray]) / 2 : 0);
      rays[ray]["curvatures"].push_back(all ? (*up[ray] + *down[ray]) / 2 - *here[ray] : 0);
    }
  }
  return rays;
}

/// As the ellipses that are drawn: in the model's own picture where there is no mammogram.
ViewUncertainty shown_uncertainty(const PatientResults& results, const ViewResult& view) {
  for (const LesionRow& row : results.rows)
    if (row.view == view.view.name && row.picture_ellipse_major_mm)
      return without_placement(*view.uncertainty);
  return *view.uncertainty;
}

json ellipse_data(const ViewUncertainty& uncertainty) {
  const auto& c = uncertainty.covariance;
  return {{"sd", std::vector<double>(uncertainty.sd.begin(), uncertainty.sd.end())},
          {"covariance", std::vector<double>(c.data(), c.data() + c.size())}};
}

/// Such a breast ends elsewhere at a little more or less of anything: no reduced model follows it.
bool slips_or_rolls(const PatientResults& results, const std::string& view) {
  const std::string product = view + ".vtu";
  const json* sidecar = results.sidecar(product);
  if (!sidecar || !sidecar->contains("quality")) return false;
  for (const char* key : {"swing_mm", "roll_deg"})
    if (const auto expected = expectation(product, key, sidecar->at("quality"));
        expected && !expected->held)
      return true;
  return false;
}

}  // namespace

std::string what_if_words() {
  return "By the model's slopes where it was computed; on a mammogram by the secants of its "
         "search. "
         "Of slopes: in " +
         std::to_string(kWhatIfViews) +
         " views that were looked at, all sliders moved at once, tissue lay " +
         word::mm(kWhatIfMedian.best_mm) + " to " + word::mm(kWhatIfMedian.worst_mm) +
         " mm in the median and " + word::mm(kWhatIfP95.best_mm) + " to " +
         word::mm(kWhatIfP95.worst_mm) +
         " mm in 95 % from where full solves put it; a view that swings or rolls beyond its limit "
         "has no sliders.";
}

json what_if_data(const PatientResults& results, const ViewResult& view) {
  if (!view.uncertainty) return nullptr;
  const bool known = std::any_of(view.what_if.begin(), view.what_if.end(),
                                 [](const WhatIfEnds& ends) { return !ends.up.empty(); });
  if (!known || slips_or_rolls(results, view.view.name)) return nullptr;
  const ReducedView what_if = what_if_view(view.what_if, view.file.mesh, view.view.frame);
  const Slopes slopes = slopes_of(view);
  const ViewProjection projection(results.prone->mesh, view.file.mesh, view.view, view.detector);
  const ViewRays rays(results.prone->mesh, view.file.mesh, view.view, view.detector);
  TrackedPoints points(what_if, slopes);
  json data = {{"ellipse", ellipse_data(shown_uncertainty(results, view))},
               {"skin", skin_data(what_if, view)},
               {"lesions", json::array()},
               {"numbers", json::array()}};
  const std::vector<Landmark> lesions = results.lesions();
  for (std::size_t n = 0; n < lesions.size(); ++n) {
    const ProjectedLandmark place = projection.project(lesions[n]);
    const int point = points.add(place.in_view, place.point);
    data["lesions"].push_back(
        {{"id", lesions[n].id},
         {"point", point},
         {"unexplained_mm2", unexplained_mm2(*view.uncertainty, view.detector, place.on_detector)},
         {"outline", outline_of(results, n, place, projection, rays, points)}});
  }
  if (const auto nipple = results.nipple()) {
    const ProjectedLandmark place = projection.project({"nipple", *nipple});
    data["nipple"] = points.add(place.in_view, place.point);
  }
  for (std::size_t n = 0; n < kWhatIf.size(); ++n)
    if (!view.what_if[n].up.empty())
      data["numbers"].push_back(
          {{"name", kStateNames[kWhatIf[n].number]}, {"mode", n}, {"range", kWhatIf[n].range}});
  data["points"] = points.packed();
  return data;
}

}  // namespace mammotwin
