#pragma once

#include <filesystem>

#include "fitting/mesh/hermite_mesh.h"
#include "segmentation/image/volume.h"

namespace mammotwin {

/// Displacement [mm, LPS] on a grid: the tissue at voxel centre x of one configuration is at
/// x + d(x) in the other. To resample the prone MRI into a compressed state, ITK and 3D Slicer need
/// the field that lives on the compressed grid ("prone_from_cc").
using DisplacementField = Volume<Eigen::Vector3f>;

/// Field over `here`'s box, `target` being the same mesh in the other configuration. Exact at voxel
/// centres inside the mesh; for interpolation near its surface the outermost layers of tissue are
/// continued straight for two voxels; 0 beyond.
DisplacementField displacement_field(const HermiteMesh& here, const HermiteMesh& target,
                                     double spacing_mm = 2);

/// d at a point by trilinear interpolation, as ITK does it; 0 outside the grid.
Eigen::Vector3d displacement_at(const DisplacementField& field, const Eigen::Vector3d& x);

/// How far a point comes back from where it was after both fields, over the voxel centres of
/// `there` inside the mesh `there_mesh`.
struct CompositionError {
  double mean_mm = 0, p99_mm = 0, max_mm = 0;
  std::size_t points = 0;
};
CompositionError composition_error(const DisplacementField& there, const DisplacementField& back,
                                   const HermiteMesh& there_mesh);

/// Corrects `back` at its voxels until both compose to the identity over the voxel centres of
/// `there` inside the mesh, to `tolerance_mm` or as near as its grid can: where the breast is bent
/// within two voxels (at the plates' edges), exact values interpolate worse than these. Each round
/// spreads what is left at every point over the voxels that it was interpolated from. Returns the
/// error that stays.
CompositionError compose_to_identity(const DisplacementField& there, const HermiteMesh& there_mesh,
                                     double tolerance_mm, DisplacementField& back);

/// NRRD with vectors of three floats, space left-posterior-superior.
void write_displacement_field(const std::filesystem::path& path, const DisplacementField& field);

}  // namespace mammotwin
