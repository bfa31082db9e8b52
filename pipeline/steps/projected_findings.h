#pragma once

#include <string>
#include <vector>

#include "registration/prediction/project_lesions.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

/// What is to be found again in the views: places in the prone MRI.
struct Findings {
  std::vector<Landmark> lesions;
  Landmark nipple;
};
Findings findings_of(const Segmentation& segmentation);

/// The same as one view shows them.
struct ProjectedFindings {
  std::vector<ProjectedLandmark> lesions;  ///< in the order of Findings
  ProjectedLandmark nipple;
};

/// Throws std::runtime_error where a lesion lies too far outside the mesh to be carried.
ProjectedFindings project(const Findings& findings, const ViewProjection& view);

}  // namespace mammotwin
