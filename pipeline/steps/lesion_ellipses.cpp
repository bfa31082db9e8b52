#include "pipeline/steps/lesion_ellipses.h"

#include "registration/carry/ray_curve.h"

namespace mammotwin {
namespace {

constexpr double kProbability = 0.9;
constexpr int kRimPoints = 36;

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

}  // namespace mammotwin
