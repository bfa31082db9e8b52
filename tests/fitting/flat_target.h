#pragma once

#include "fitting/mesh/block_mesh.h"
#include "fitting/solve/fit_samples.h"

namespace mammotwin {

/// Bricks that lie as a breast's slab does (ξ₂ along z, ξ₃ towards −y) between a wall y = 0 and a
/// skin to fit, a plane that lies `beyond` mm in front of theirs.
struct FlatTarget {
  static constexpr double side = 20, depth = 10;  // [mm]

  Slab slab;
  HermiteMesh box;
  TriangleSurface skin;
  FlatSkin flat;
  HeightField wall;
  FitTarget target;

  double skin_y() const { return skin.vertices[0].y(); }

  FlatTarget(const Eigen::Vector3i& elements, double beyond)
      : slab{elements},
        box(lying_box(elements)),
        skin(sheet(-depth - beyond)),
        flat(flat_sheet()),
        wall(Volume<std::uint8_t>({2, 1, 2}, {side, 1, side}, {0, 0, 0}),
             std::vector<double>(4, 0.0)),
        target(slab, skin, flat, wall, Eigen::Vector3d(1e6, 0, 0)) {
    target.weigh_mesh(box);
  }
  FlatTarget(const FlatTarget&) = delete;

 private:
  static constexpr int points = 9;  // a side of the sheet

  static HermiteMesh lying_box(const Eigen::Vector3i& elements) {
    const HermiteMesh box =
        block_mesh(Eigen::Vector3d::Zero(), Eigen::Vector3d(side, side, depth), elements);
    Eigen::Matrix3d turn;
    turn << 1, 0, 0, 0, 0, -1, 0, 1, 0;
    std::vector<HermiteMesh::Node> nodes;
    for (const auto& node : box.nodes()) nodes.push_back(turn * node);
    return HermiteMesh(nodes, box.elements());
  }

  static TriangleSurface sheet(double y) {
    TriangleSurface sheet;
    const int n = points - 1;
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i) sheet.vertices.emplace_back(side * i / n, y, side * j / n);
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        const int v = i + points * j;
        sheet.triangles.push_back({v, v + 1, v + points + 1});
        sheet.triangles.push_back({v, v + points + 1, v + points});
      }
    return sheet;
  }

  static FlatSkin flat_sheet() {
    FlatSkin flat;
    const int n = points - 1;
    for (int j = 0; j <= n; ++j)
      for (int i = 0; i <= n; ++i)
        flat.uv.emplace_back(static_cast<double>(i) / n, static_cast<double>(j) / n);
    for (int k = 0; k <= n; ++k) {
      flat.edges[0].push_back(k * points);
      flat.edges[1].push_back(k * points + n);
      flat.edges[2].push_back(k);
      flat.edges[3].push_back(n * points + k);
    }
    return flat;
  }
};

}  // namespace mammotwin
