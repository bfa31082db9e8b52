#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "fitting/mesh/inverse_map.h"
#include "fitting/mesh/mesh_file.h"
#include "pipeline/evaluate/cases/sorted_figures.h"
#include "registration/view/view_frame.h"

namespace mammotwin {

/// fractions.nrrd, as `segment` puts it beside its segmentation.
std::filesystem::path fractions_beside(const std::filesystem::path& segmentation);

/// Where prone places come to lie in a compression, in the view's frame relative to the nipple.
class PressedPlaces {
 public:
  /// `pressed`: the mesh that `compress` wrote of `view`.
  PressedPlaces(const std::filesystem::path& pressed, const std::string& view,
                const std::filesystem::path& segmentation);
  Eigen::Vector3d of(const Eigen::Vector3d& x_prone) const { return in_frame(x_prone) - nipple_; }

 private:
  Eigen::Vector3d in_frame(const Eigen::Vector3d& x_prone) const;

  MeshFile file_;
  ViewFrame frame_;
  InverseMap prone_;
  Eigen::Vector3d nipple_ = Eigen::Vector3d::Zero();
};

/// Prone places to follow [mm, LPS]: the centroids of the lesions in the breast's region, and 50
/// points of the mesh's elements, always the same.
struct FollowedPoints {
  std::vector<Eigen::Vector3d> lesions, tissue;

  FollowedPoints(const std::filesystem::path& segmentation, const std::filesystem::path& prone);
};

/// Sorted distances between places in one compression and in another [mm]; `counterpart`: the
/// point's prone place in the other one.
std::vector<double> moves(const std::vector<Eigen::Vector3d>& points, const PressedPlaces& base,
                          const PressedPlaces& changed,
                          const std::function<Eigen::Vector3d(Eigen::Vector3d)>& counterpart);

/// `lesion_median_mm`, `lesion_max_mm` (where it has lesions), `tissue_median_mm` and
/// `tissue_max_mm`: moves of the same prone places.
void add_moves(const FollowedPoints& points, const PressedPlaces& base,
               const PressedPlaces& changed, nlohmann::json& row);

}  // namespace mammotwin
