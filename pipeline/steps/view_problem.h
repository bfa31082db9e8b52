#pragma once

#include "pipeline/patient/patient.h"
#include "registration/search/reduced_view.h"
#include "solver/press/compression_problem.h"
#include "solver/press/compression_result.h"

namespace mammotwin {

/// Plates of a view as patient.toml says; `mesh` is the breast as imaged.
PlateOptions plates_of(const Patient& patient, const ViewSettings& view,
                       const Eigen::Matrix3d& axes, const MeshFile& mesh);

/// The compression of one view. `mesh` is what unload or fit made.
CompressionProblem view_problem(const Patient& patient, const ViewSettings& view,
                                const Eigen::Matrix3d& axes, const MeshFile& mesh,
                                const TissueSampler& tissue);

/// Adds to a compressed mesh's metadata what a solve from there needs.
void remember_solution(const CompressionResult& result, MeshFile& file);

/// A solution read back from a compressed mesh, ready for solves near it; empty where the file was
/// written without one.
std::optional<NearbySolver> nearby_solver(const Patient& patient, const CompressedView& view,
                                          const MeshFile& compressed, const TissueSampler& tissue);

}  // namespace mammotwin
