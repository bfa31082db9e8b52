#pragma once

#include "pipeline/patient/compression_settings.h"
#include "segmentation/segmentation.h"
#include "solver/breast/breast_problem.h"

namespace mammotwin {

/// Tissue at the Gauss points of a mesh file's elements, counted once from the voxels that lie in
/// them as imaged (fitting/tissue/cell_tissue.h).
TissueSampler tissue_of(const MeshFile& mesh, const Volume<Fractions>& fractions);

/// The patient's breast as the solver takes it, without gravity: a mesh file's shape (and
/// its configuration "prone", where it has one), the tissue in it, laws, skin and what holds it.
/// All stiffnesses are multiplied by `stiffness_factor`.
BreastProblem breast_problem(MeshFile mesh, TissueSampler tissue,
                             const CompressionSettings& settings, double stiffness_factor);

/// The factor that `unload` used, from the metadata of the mesh that it wrote; else the settings'.
double stiffness_factor_of(const MeshFile& mesh, const CompressionSettings& settings);

void write_stiffness_factor(double factor, MeshFile& file);

/// Largest way of a chest-wall node between two shapes of the mesh [mm].
double wall_slide(const MeshFile& mesh, const std::vector<HermiteMesh::Node>& from,
                  const std::vector<HermiteMesh::Node>& to);

/// The mesh as imaged: the configuration "prone" of a file, else the file itself.
MeshFile prone_file(const MeshFile& file);

}  // namespace mammotwin
