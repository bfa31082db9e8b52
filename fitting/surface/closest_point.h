#pragma once

#include <memory>

#include "fitting/surface/triangle_surface.h"

namespace mammotwin {

/// Nearest points of a triangle surface; queries are const and may run in parallel.
class ClosestPoint {
 public:
  explicit ClosestPoint(const TriangleSurface& surface);
  ~ClosestPoint();

  struct Hit {
    Eigen::Vector3d x;       ///< [mm]
    Eigen::Vector3d normal;  ///< of its triangle, length 1
    int triangle;
  };
  Hit operator()(const Eigen::Vector3d& x) const;

 private:
  struct Tree;
  std::unique_ptr<Tree> tree_;
};

}  // namespace mammotwin
