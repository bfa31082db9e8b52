#include "pipeline/steps/breast_problem.h"

#include <algorithm>
#include <stdexcept>
#include <string>
#include <utility>

#include "fitting/mesh/metadata_field.h"
#include "fitting/tissue/cell_tissue.h"

namespace mammotwin {
namespace {
constexpr const char* kStiffnessFactor = "stiffness_factor";

/// Without them nobody knows where skin and chest wall are.
void require_face_labels(const MeshFile& mesh) {
  if (static_cast<int>(mesh.faces.size()) == mesh.mesh.num_elements()) return;
  throw std::runtime_error("the mesh's array face_labels has " + std::to_string(mesh.faces.size()) +
                           " rows; expected " + std::to_string(mesh.mesh.num_elements()) +
                           ", one an element: make the mesh again with fit");
}

}  // namespace

TissueSampler tissue_of(const MeshFile& mesh, const Volume<Fractions>& fractions) {
  const auto tissue = std::make_shared<const CellTissue>(prone_file(mesh).mesh, fractions);
  return [tissue](const Eigen::Vector3d& x_prone, double) {
    const Fractions f = tissue->at(x_prone);
    return std::array<double, 3>{f.fat, f.fibroglandular, f.lesion};
  };
}

BreastProblem breast_problem(MeshFile mesh, TissueSampler tissue,
                             const CompressionSettings& settings, double stiffness_factor) {
  require_face_labels(mesh);
  BreastProblem problem;
  problem.mesh = std::move(mesh);
  if (const auto prone = problem.mesh.configurations.find("prone");
      prone != problem.mesh.configurations.end())
    problem.prone = prone->second;
  problem.tissue = std::move(tissue);
  problem.laws = settings.laws(stiffness_factor);
  problem.skin = settings.skin;
  problem.skin.c1 *= stiffness_factor;
  problem.boundary = settings.boundary;
  problem.boundary.chest_wall_spring *= stiffness_factor;
  return problem;
}

double stiffness_factor_of(const MeshFile& mesh, const CompressionSettings& settings) {
  const auto* written = find_field(mesh.metadata, "the mesh", kStiffnessFactor, 1);
  return written ? written->front() : settings.stiffness_factor;
}

void write_stiffness_factor(double factor, MeshFile& file) {
  file.metadata[kStiffnessFactor] = {factor};
}

MeshFile prone_file(const MeshFile& file) {
  MeshFile prone = file;
  if (const auto found = file.configurations.find("prone"); found != file.configurations.end())
    prone.mesh = HermiteMesh(found->second, file.mesh.elements());
  return prone;
}

double wall_slide(const MeshFile& mesh, const std::vector<HermiteMesh::Node>& from,
                  const std::vector<HermiteMesh::Node>& to) {
  double slide = 0;
  for (int e = 0; e < mesh.mesh.num_elements(); ++e)
    for (int face = 0; face < 6; ++face)
      for (int c = 0; mesh.faces[e][face] == FaceLabel::chest_wall && c < 8; ++c)
        if ((c >> (face / 2) & 1) == face % 2) {
          const int node = mesh.mesh.corners(e)[c];
          slide = std::max(slide, (from[node].col(0) - to[node].col(0)).norm());
        }
  return slide;
}

}  // namespace mammotwin
