#include "pipeline/steps/second_state.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "fitting/surface/label_surface.h"
#include "fitting/surface/read_surface.h"
#include "segmentation/files/read_labels.h"

namespace mammotwin {
namespace {

bool is_surface(const std::filesystem::path& path) {
  const std::string ending = path.extension().string();
  for (const char* known : {".ply", ".stl", ".obj", ".off"})
    if (ending == known) return true;
  return false;
}

/// Boundary of what is not air, after a Gaussian of a voxel against steps.
TriangleSurface boundary_of_labels(const std::filesystem::path& path) {
  const Volume<std::uint16_t> labels = read_labels(path);
  Volume<float> solid = labels.like<float>();
  std::transform(labels.values.begin(), labels.values.end(), solid.values.begin(),
                 [](std::uint16_t value) { return value == 0 ? 0.0f : 1.0f; });
  return solid_boundary(smoothed(solid, solid.spacing.maxCoeff()));
}

TriangleSurface read_state(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path))
    throw std::runtime_error(path.string() + ": no such file (unload.second_state)");
  return is_surface(path) ? read_surface(path) : boundary_of_labels(path);
}

std::vector<MeshPoint> skin_points(const MeshFile& mesh) {
  constexpr int points1d = 4;
  std::vector<MeshPoint> points;
  for (int e = 0; e < mesh.mesh.num_elements(); ++e) {
    const FaceLabels& faces = mesh.faces[e];
    if (std::find(faces.begin(), faces.end(), FaceLabel::cut) != faces.end()) continue;
    for (int face = 0; face < 6; ++face)
      for (int k = 0; faces[face] == FaceLabel::skin && k < points1d * points1d; ++k) {
        Eigen::Vector3d xi = Eigen::Vector3d::Constant(face % 2);
        xi[(face / 2 + 1) % 3] = (k % points1d + 0.5) / points1d;
        xi[(face / 2 + 2) % 3] = (k / points1d + 0.5) / points1d;
        points.push_back({e, xi});
      }
  }
  return points;
}

}  // namespace

SecondState::SecondState(const std::filesystem::path& path, const MeshFile& mesh)
    : closest_(read_state(path)), elements_(mesh.mesh.elements()), skin_(skin_points(mesh)) {
  if (skin_.empty())
    throw std::runtime_error("the mesh has no skin away from its cut faces to compare with " +
                             path.string() + "; ask for more fit.elements");
}

double SecondState::distance(const std::vector<HermiteMesh::Node>& deformed) const {
  const HermiteMesh mesh(deformed, elements_);
  double sum = 0;
  for (const MeshPoint& point : skin_) {
    const Eigen::Vector3d x = mesh.position(point);
    sum += (closest_(x).x - x).squaredNorm();
  }
  return std::sqrt(sum / skin_.size());
}

}  // namespace mammotwin
