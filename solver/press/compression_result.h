#pragma once

#include <map>
#include <string>
#include <vector>

#include "fitting/mesh/mesh_file.h"
#include "solver/contact/plate_friction.h"
#include "solver/contact/plate_placement.h"

namespace mammotwin {

struct CompressionStep {
  double thickness_mm = 0;  ///< measured
  double force_N = 0;       ///< of the paddle
  int iterations = 0;
  double penalty = 0;  ///< [kPa/mm]
  double min_J = 1, max_J = 1;
  std::vector<HermiteMesh::Node> deformed;
};

enum class CompressionStatus { converged, not_converged };

struct CompressionReport {
  CompressionStatus status = CompressionStatus::not_converged;
  std::string reason;              ///< why not, with the last good thickness
  int presses = 1;                 ///< more: once more, drawn harder or carefully (compress)
  int other_press_iterations = 0;  ///< of the presses that are not this result's
  double drawn_times = 1;          ///< so many times the problem's pull
  int steps = 0, cutbacks = 0;
  int newton_iterations = 0, indefinite_matrices = 0;  ///< of all presses
  double target_thickness_mm = 0;  ///< asked, or where the most force was reached
  bool stopped_by_force = false;   ///< CompressionProblem::most_force
  double thickness_mm = 0;         ///< extent along `up` of the deformed skin between the plates
  double free_thickness_mm = 0;    ///< the same of the uncompressed breast
  double force_N = 0;              ///< of the paddle, from contact
  double energy_force_N = 0;       ///< the same from the change of stored energy, a check
  double paddle_tilt_deg = 0;      ///< in the end
  double contact_area_cm2 = 0;     ///< deformed, within 0.1 mm of the paddle
  double gap_p95_mm = 0;           ///< of the skin to both plates where they press (pressed_gap.h)
  double volume_change = 0;        ///< fraction
  double min_J = 1, max_J = 1;
  double J_within_half = 0;  ///< fraction of quadrature points with J in [0.5, 1.5]
  double mean_gap_mm = 0;    ///< of what a plate presses (ContactFigures), the larger of both
  double max_penetration_mm = 0;
  double imbalance = 0;          ///< of forces, over their flow (Balance)
  double retained_fraction = 1;  ///< of the tissue in front of the plates' edges, how much stays
  bool slipped_out = false;      ///< backwards from between the plates
  double wall_gap_mm = 0;        ///< most that the chest-wall face left its distance to the wall
  double seconds = 0;
  int dof = 0;
  std::vector<CompressionStep> history;
  bool usable() const { return status == CompressionStatus::converged; }
};

struct CompressionResult {
  std::vector<HermiteMesh::Node> deformed;   ///< at the last good step
  std::vector<HermiteMesh::Node> found;      ///< as the plates found the breast: at rest
  std::vector<double> pressure;              ///< 8 an element (State::pressure)
  PlacedPlates plates;                       ///< where they ended
  double penalty = 0;                        ///< of contact in the end [kPa/mm]
  std::vector<PlateFriction::Hold> holds;    ///< of friction in the end; empty without
  std::map<std::string, PointField> fields;  ///< press/solution_fields.h; empty if not usable
  CompressionReport report;
};

}  // namespace mammotwin
