#include "pipeline/patient/gravity_settings.h"

#include <stdexcept>
#include <utility>

namespace mammotwin {
namespace {

constexpr double kGravity = 9810;  // [mm/s²]

const std::vector<std::pair<std::string, Pose>> kPoses = {{"prone", Pose::prone},
                                                          {"supine", Pose::supine},
                                                          {"standing", Pose::standing},
                                                          {"none", Pose::none}};

}  // namespace

std::string name_of(Pose pose) { return detail::name_of(pose, kPoses); }

Eigen::Vector3d gravity_in_lps(Pose pose) {
  switch (pose) {
    case Pose::prone:
      return {0, -kGravity, 0};
    case Pose::supine:
      return {0, kGravity, 0};
    case Pose::standing:
      return {0, 0, -kGravity};
    case Pose::none:
      return Eigen::Vector3d::Zero();
  }
  throw std::logic_error("unknown pose");
}

void declare_gravity(Settings& s, GravitySettings& gravity) {
  s.choice("gravity", gravity.imaged, kPoses,
           "how the patient lay or stood when imaged, default as the image's header says, else "
           "prone, for a "
           "scan none; none: the shape is taken as free of stress");
  s.number("unload.density_kg_per_m3", gravity.density_kg_per_m3, {500, 2000, "kg/m^3"},
           "density of the breast");
  s.path("unload.second_state", gravity.second_state,
         "the same breast in another pose, same chest wall: surface (PLY, STL, OBJ) or label map; "
         "one factor for all stiffnesses is fitted to it");
  s.choice("unload.second_gravity", gravity.second_gravity,
           {{"supine", Pose::supine}, {"standing", Pose::standing}, {"prone", Pose::prone}},
           "the pose of `unload.second_state`");
  s.number("unload.coil_roundness", gravity.coil_roundness, {0, 1.5},
           "width over height of the front half, free of load, of a breast that the coil pressed; "
           "default: 0.8 for one that shows it; 0: it stays as narrow as imaged");
}

}  // namespace mammotwin
