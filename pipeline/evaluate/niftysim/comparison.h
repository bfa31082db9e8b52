#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

#include "pipeline/evaluate/niftysim/half_ball_mesh.h"
#include "pipeline/evaluate/niftysim/plate_squeeze.h"
#include "solver/element/solid_element.h"

namespace mammotwin {

struct NiftySimOptions {
  HalfBallElements elements;
  double grad_div = SolidOptions{}.grad_div;
  bool skin = true;       ///< a membrane as thick as the file's skin is on average
  bool held_roll = true;  ///< at NiftySim's own; see pipeline/evaluate/niftysim/README.md
};

struct NiftySimComparison {
  MeshFile compressed{HermiteMesh({}, {}), {}, {}, {}, {}, {}};  ///< ours, "prone" in it
  /// displacement_difference {rms_mm, p95_mm, max_mm} over the nodes and what it was made with.
  nlohmann::json figures;
  std::string reason;  ///< why there is no equilibrium; empty where there is
};

/// Compresses the breast of `folder` (volmesh3-model.xml, volmesh3_compressed.vtk) once more on a
/// Hermite mesh fitted to it, and compares the displacement of NiftySim's nodes.
NiftySimComparison compare_with_niftysim(const std::filesystem::path& folder,
                                         const NiftySimOptions& options);

}  // namespace mammotwin
