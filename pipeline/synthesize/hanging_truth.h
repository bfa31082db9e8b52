#pragma once

#include <functional>

#include "fitting/mesh/mesh_file.h"
#include "pipeline/synthesize/patient.h"
#include "solver/breast/breast_problem.h"

namespace mammotwin {

/// Elements of the truth's mesh: finer in each direction than what `fit` makes by default.
inline const Eigen::Vector3i kTruthElements{8, 8, 3};

/// The shape free of stress of which the synthetic breast is the hanging one: default tissue laws
/// on the true fractions, on a finer mesh fitted to the true labels. The file shows that shape; its
/// configuration "prone" is the body as made. Loaded by gravity it hangs into that body to 1e-3 mm,
/// which is checked here; std::runtime_error where it does not.
MeshFile hanging_truth(const SyntheticPatient& patient,
                       const std::function<void(double, const std::string&)>& progress = {});

/// Calls `use` with the true breast on the given mesh (its configuration "prone", where it has
/// one), prone gravity on it.
void with_true_breast(const SyntheticPatient& patient, const MeshFile& mesh,
                      const std::function<void(const BreastProblem&)>& use);

}  // namespace mammotwin
