#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/patient/compression_settings.h"
#include "registration/prediction/project_lesions.h"
#include "registration/search/search_ellipse.h"
#include "registration/search/search_verdict.h"
#include "registration/search/what_if.h"

namespace mammotwin {

/// The breast prone and compressed in one view, ready to be looked at from its detector.
struct RegisteredView {
  MeshFile file;  ///< what was read
  HermiteMesh prone, compressed;
  ViewProjection projection;
  /// The same breast in other states that unload found, by name: "unloaded", "standing", "supine".
  std::map<std::string, HermiteMesh> states;
  std::optional<ViewUncertainty> uncertainty;  ///< of a view whose sensitivities were solved for
  WhatIfShapes what_if{};
  SearchEnd end = SearchEnd::none;  ///< of the search against its mammogram

  /// Covariance of a material point on the detector [mm^2]; empty without an uncertainty.
  std::optional<Eigen::Matrix2d> covariance(const MeshPoint& point) const;

  /// The same in the model's own picture (without_placement).
  std::optional<Eigen::Matrix2d> covariance_in_picture(const MeshPoint& point) const;
};

/// Reads what compress wrote (cc.vtu), or register (cc_registered.vtu).
/// Throws std::runtime_error naming the file and what is missing in it.
RegisteredView read_registered_view(const std::string& name, const std::filesystem::path& path,
                                    const ViewSettings& settings);

/// What `read_registered_view` reads back: the registered mesh with its view and its record
/// (pipeline/steps/registered_record.h).
void write_registered_view(const std::filesystem::path& path, const RegisteredView& view);

/// Table of target registration errors for a file of landmark pairs.
/// Throws std::runtime_error where a view that has marks has no pixel spacing.
std::string landmark_errors(const std::filesystem::path& pairs,
                            const std::vector<RegisteredView>& views);

}  // namespace mammotwin
