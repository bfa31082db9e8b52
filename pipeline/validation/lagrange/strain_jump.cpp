#include "pipeline/validation/lagrange/strain_jump.h"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <map>
#include <vector>

#include "pipeline/validation/lagrange/lagrange_mesh.h"

namespace mammotwin {

namespace {

constexpr int kSamplesASide =
    4;  // a side; a grid without points on edges, symmetric under the face's turns

struct Sample {
  Eigen::Matrix3d E;
  int element;
};

Eigen::Matrix3d strain(const HermiteMesh& before, const HermiteMesh& after, const MeshPoint& p) {
  const Eigen::Matrix3d F = after.jacobian(p) * before.jacobian(p).inverse();
  return (F.transpose() * F - Eigen::Matrix3d::Identity()) / 2;
}

}  // namespace

double strain_jump(const HermiteMesh& before, const HermiteMesh& after) {
  std::map<std::array<long, 3>, std::vector<Sample>> samples;
  for (int e = 0; e < before.num_elements(); ++e)
    for (int face = 0; face < 6; ++face)
      for (int k = 0; k < kSamplesASide * kSamplesASide; ++k) {
        MeshPoint p{e, {}};
        p.xi[face / 2] = face % 2;
        p.xi[(face / 2 + 1) % 3] = (k % kSamplesASide + 0.5) / kSamplesASide;
        p.xi[(face / 2 + 2) % 3] = (k / kSamplesASide + 0.5) / kSamplesASide;
        samples[place_key(before.position(p))].push_back({strain(before, after, p), e});
      }
  double jumps = 0, strains = 0;
  for (const auto& [place, at] : samples) {
    if (at.size() != 2 || at[0].element == at[1].element) continue;
    jumps += (at[0].E - at[1].E).squaredNorm();
    strains += (at[0].E.squaredNorm() + at[1].E.squaredNorm()) / 2;
  }
  return strains > 0 ? std::sqrt(jumps / strains) : 0;
}

}  // namespace mammotwin
