#pragma once

#include <optional>
#include <string>

#include "fitting/mesh/mesh_file.h"
#include "registration/prediction/affine_baseline.h"
#include "registration/search/search_ellipse.h"
#include "registration/search/search_verdict.h"
#include "registration/search/what_if.h"

namespace mammotwin {

/// What `register` leaves in a view's mesh file, besides the shape and its view, for `mark`,
/// `report` and evaluations.
struct RegisteredRecord {
  /// Where the prediction without physics was placed: it is that of the header's view.
  struct Baseline {
    ViewFrame frame;
    double thickness_mm = 0;
    double turn_deg = 0;
    Eigen::Vector2d shift_mm = Eigen::Vector2d::Zero();
  };
  std::optional<Baseline> baseline;
  std::optional<ViewUncertainty> uncertainty;  ///< of a view whose sensitivities were solved for
  WhatIfShapes what_if{};                      ///< likewise
  SearchEnd end = SearchEnd::none;             ///< of the search against its mammogram
};

RegisteredRecord::Baseline record_of(const AffineBaseline& baseline);

/// The baseline of `prone` where the record has it; `view` says the rest.
AffineBaseline baseline_of(const RegisteredRecord::Baseline& record, const HermiteMesh& prone,
                           CompressedView view);

/// As fields `baseline`, `state_sd`, `state_covariance`, `discrepancy_mm`, `plates_edge` and
/// `search_end`, and as the breast with each state's number varied, "varied_roll_deg" and so on,
/// and at the ends of what a reader may vary, "what_if_up_roll_deg", "what_if_down_roll_deg", among
/// the configurations.
void write_registered(const RegisteredRecord& record, MeshFile& file);

/// Throws std::runtime_error naming `name` and the field that is damaged.
RegisteredRecord read_registered(const MeshFile& file, const std::string& name);

/// Is a configuration of the file part of the record, and not a state that `unload` found?
bool is_of_registration(const std::string& configuration);

}  // namespace mammotwin
