#include "pipeline/steps/lesion_ellipses.h"

#include <cmath>
#include <numbers>

#include "pipeline/frame/sentence.h"
#include "registration/carry/ray_curve.h"

namespace mammotwin {
namespace {

constexpr double kProbability = 0.9;
constexpr int kRimPoints = 36;

/// How far an ellipse reaches along depth from its middle [mm].
double depth_reach(const SearchEllipse& ellipse) {
  const double t = ellipse.angle_deg * std::numbers::pi / 180;
  return std::hypot(ellipse.major_mm * std::cos(t), ellipse.minor_mm * std::sin(t));
}

}  // namespace

std::vector<LesionEllipse> lesion_ellipses(const ProjectedFindings& findings,
                                           const RegisteredView& view, bool has_mammogram) {
  if (!view.uncertainty) return {};
  const ViewRays rays(view.prone, view.compressed, view.projection.view(),
                      view.projection.detector());
  std::vector<LesionEllipse> ellipses;
  for (const ProjectedLandmark& lesion : findings.lesions) {
    LesionEllipse& found = ellipses.emplace_back();
    found.on_detector = search_ellipse(view.covariance(lesion.point).value(), kProbability);
    if (!has_mammogram)
      found.in_picture =
          search_ellipse(view.covariance_in_picture(lesion.point).value(), kProbability);
    const SearchEllipse& shown = found.in_picture ? *found.in_picture : found.on_detector;
    found.rim_in_prone =
        ellipse_in_prone(rays, lesion.on_detector, rim(shown, kRimPoints), lesion.in_view.z());
  }
  return ellipses;
}

std::vector<std::string> edge_remarks(const ProjectedFindings& findings,
                                      const std::vector<LesionEllipse>& ellipses,
                                      const std::string& view) {
  std::vector<std::string> remarks;
  for (std::size_t i = 0; i < findings.lesions.size(); ++i) {
    const double depth = findings.lesions[i].on_detector.x();
    if (depth >= 0) continue;
    const double front = depth + (ellipses.empty() ? 0 : depth_reach(ellipses[i].on_detector));
    const std::string text =
        front > 0 ? sentence(
                        "predicted %.0f mm behind the detector's edge in %s, its 90 %% ellipse "
                        "%.0f mm in front of it: that mammogram may not show it",
                        -depth, view.c_str(), front)
                  : sentence(
                        "predicted %.0f mm behind the detector's edge in %s: that mammogram would "
                        "not show it",
                        -depth, view.c_str());
    remarks.push_back("lesion " + findings.lesions[i].landmark.id + " is " + text);
  }
  return remarks;
}

}  // namespace mammotwin
