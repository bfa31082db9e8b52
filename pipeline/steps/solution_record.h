#pragma once

#include <optional>
#include <string>
#include <vector>

#include "fitting/mesh/mesh_file.h"
#include "solver/contact/plate_friction.h"

namespace mammotwin {

/// What `compress` leaves in its mesh file, besides the shape, for solves that start from there.
struct SolutionRecord {
  std::vector<double> pressure_kpa;  ///< of every pressure unknown
  double support_height_mm = 0;      ///< of the support's face along the beam
  double paddle_height_mm = 0;
  double edge_mm = 0;                      ///< of the plates' rear edges along depth
  double lateral_middle_mm = 0;            ///< of the plates, sideways
  double penalty_kpa_per_mm = 0;           ///< of contact
  double target_thickness_mm = 0;          ///< asked of the plates
  double drawn_times = 1;                  ///< so many times the pull of others
  std::vector<PlateFriction::Hold> holds;  ///< of friction
};

void write_solution(const SolutionRecord& solution, MeshFile& file);

/// Nothing where the file was written without one. Throws std::runtime_error naming `name` and the
/// field that is damaged.
std::optional<SolutionRecord> read_solution(const MeshFile& file, const std::string& name);

/// For a mesh whose shape is no longer the solved one.
void erase_solution(MeshFile& file);

}  // namespace mammotwin
