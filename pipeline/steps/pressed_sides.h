#pragma once

#include <optional>
#include <vector>

#include "fitting/mesh/mesh_file.h"
#include "pipeline/steps/coil_plates.h"
#include "solver/breast/pressed_skin.h"

namespace mammotwin {

/// How round a breast is: of the tissue that lies, as imaged, in front of the middle between chest
/// wall and tip, the spread from side to side over that from head to foot (standard deviations).
class Roundness {
 public:
  /// `across`: horizontal, from side to side (unit).
  Roundness(const MeshFile& imaged, const Eigen::Vector3d& across);

  /// Of that tissue in another shape of the mesh.
  double of(const std::vector<HermiteMesh::Node>& shape) const;

 private:
  struct Sample {
    MeshPoint point;
    double volume;
  };
  std::vector<HermiteMesh::Corners> elements_;
  std::vector<Sample> samples_;
  Eigen::Vector3d across_;
};

/// A breast that a coil pressed flat from both sides.
struct PressedSides {
  std::optional<CoilPlates> plates;  ///< where their planes show
  double roundness = 0;              ///< as imaged
  Eigen::Vector3d across = Eigen::Vector3d::UnitX();
};

/// Less round than any breast that hangs: those have 0.61 to 1.01 on 20 sides of label maps (plates
/// show on three, but did little) and one of MRI, eight sides of four patients between a coil's
/// plates 0.33 to 0.50, a drawn breast pressed by a quarter 0.58.
inline constexpr double kFlat = 0.6;

/// Where the skin shows plates, or the breast is less round than `flat`.
std::optional<PressedSides> find_pressed_sides(const MeshFile& imaged, double flat = kFlat);

/// Their skin, as far as it faces its side and lies in front of the chest wall: an ellipse on each,
/// whose middle goes outward farthest.
PressedSkin pressed_skin(const MeshFile& imaged, const PressedSides& sides);

}  // namespace mammotwin
