#pragma once

#include <functional>

#include "pipeline/report/drawing/depth_image.h"
#include "pipeline/report/drawing/mesh_surface.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

/// Rows: right, up and towards the eye, for an eye in front of the patient, turned to the breast's
/// side and raised [rad], in LPS.
Eigen::Matrix3d eye_axes(Side side, double turn, double rise);

/// A colour as a surface of that normal shows it under a lamp above the eye.
Colour shaded(const Colour& base, const Eigen::Vector3d& normal);

/// Draws the triangles that face the eye, or those that turn away from it, coloured by index.
void draw_surface(DepthImage& image, const FaceTriangles& surface, const Eigen::Matrix3d& axes,
                  bool facing, const std::function<Colour(std::size_t)>& colour);

}  // namespace mammotwin
