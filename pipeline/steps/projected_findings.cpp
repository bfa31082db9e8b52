#include "pipeline/steps/projected_findings.h"

#include <stdexcept>

#include "pipeline/frame/sentence.h"

namespace mammotwin {
namespace {

/// A lesion that the mesh does not hold has no position that could be trusted.
void require_inside(const ProjectedLandmark& lesion) {
  if (lesion.outside_mm <= kLesionOutsideLimit_mm) return;
  throw std::runtime_error(
      sentence("lesion %s lies %.1f mm outside the breast's mesh; at most %.0f mm can be carried: "
               "look at the chest wall and at the lesion's place in the report",
               lesion.landmark.id.c_str(), lesion.outside_mm, kLesionOutsideLimit_mm));
}

}  // namespace

Findings findings_of(const Segmentation& segmentation) {
  Findings findings{{}, {"nipple", segmentation.nipple_in_lps}};
  for (const Lesion& lesion : segmentation.lesions)
    findings.lesions.push_back({lesion.id, lesion.centroid_in_lps});
  return findings;
}

ProjectedFindings project(const Findings& findings, const ViewProjection& view) {
  ProjectedFindings projected{{}, view.project(findings.nipple)};
  for (const Landmark& landmark : findings.lesions) {
    projected.lesions.push_back(view.project(landmark));
    require_inside(projected.lesions.back());
  }
  return projected;
}

}  // namespace mammotwin
