#pragma once

#include "pipeline/steps/projected_findings.h"
#include "pipeline/steps/registered_view.h"

namespace mammotwin {

/// Where to search for one lesion in one view.
struct LesionEllipse {
  SearchEllipse on_detector;
  /// In the model's own picture, for a view without a mammogram to search in.
  std::optional<SearchEllipse> in_picture;
  std::vector<Eigen::Vector3d> rim_in_prone;  ///< of the one that is shown, in LPS [mm]
};

/// The 90 % ellipse of each lesion, in their order; empty where the view's uncertainty is not
/// known. Half of the probability lies within 0.55 of the semi-axes.
std::vector<LesionEllipse> lesion_ellipses(const ProjectedFindings& findings,
                                           const RegisteredView& view, bool has_mammogram);

/// For a person: which lesions are predicted behind the detector's edge in `view`, and whether that
/// mammogram may show them all the same, as their ellipses reach in front of it.
std::vector<std::string> edge_remarks(const ProjectedFindings& findings,
                                      const std::vector<LesionEllipse>& ellipses,
                                      const std::string& view);

}  // namespace mammotwin
