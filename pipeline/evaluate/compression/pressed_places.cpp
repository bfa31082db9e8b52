#include "pipeline/evaluate/compression/pressed_places.h"

#include <algorithm>
#include <nlohmann/json.hpp>
#include <random>

#include "pipeline/steps/breast_problem.h"
#include "registration/view/compressed_view.h"
#include "segmentation/segmentation_file.h"

namespace mammotwin {
namespace {

constexpr int kTissuePoints = 50, kPointSeed = 1;

Segmentation segmentation_at(const std::filesystem::path& segmentation) {
  return read_segmentation(segmentation, fractions_beside(segmentation));
}

}  // namespace

std::filesystem::path fractions_beside(const std::filesystem::path& segmentation) {
  return segmentation.parent_path() / "fractions.nrrd";
}

PressedPlaces::PressedPlaces(const std::filesystem::path& pressed, const std::string& view,
                             const std::filesystem::path& segmentation)
    : file_(read_mesh_file(pressed)),
      frame_(compressed_view(view, pressed.filename(), file_.metadata).frame),
      prone_(prone_file(file_).mesh) {
  nipple_ = in_frame(segmentation_at(segmentation).nipple_in_lps);
}

Eigen::Vector3d PressedPlaces::in_frame(const Eigen::Vector3d& x_prone) const {
  return frame_.view_from_lps(file_.mesh.position(prone_.nearest(x_prone)));
}

FollowedPoints::FollowedPoints(const std::filesystem::path& segmentation,
                               const std::filesystem::path& prone) {
  const Segmentation s = segmentation_at(segmentation);
  for (const Lesion& lesion : s.lesions)
    if (s.region.contains(lesion.centroid_in_lps)) lesions.push_back(lesion.centroid_in_lps);
  const HermiteMesh mesh = read_mesh_file(prone).mesh;
  std::mt19937 random(kPointSeed);
  const auto share = [&] { return random() / 4294967296.0; };
  for (int n = 0; n < kTissuePoints; ++n) {
    const int element = static_cast<int>(share() * mesh.num_elements());
    tissue.push_back(mesh.position({element, {share(), share(), share()}}));
  }
}

std::vector<double> moves(const std::vector<Eigen::Vector3d>& points, const PressedPlaces& base,
                          const PressedPlaces& changed,
                          const std::function<Eigen::Vector3d(Eigen::Vector3d)>& counterpart) {
  std::vector<double> all;
  for (const Eigen::Vector3d& x : points)
    all.push_back((changed.of(counterpart(x)) - base.of(x)).norm());
  std::sort(all.begin(), all.end());
  return all;
}

void add_moves(const FollowedPoints& points, const PressedPlaces& base,
               const PressedPlaces& changed, nlohmann::json& row) {
  const auto add = [&](const std::vector<Eigen::Vector3d>& some, const std::string& what) {
    if (some.empty()) return;
    const auto sorted = moves(some, base, changed, [](Eigen::Vector3d x) { return x; });
    row[what + "_median_mm"] = median_of_sorted(sorted);
    row[what + "_max_mm"] = sorted.back();
  };
  add(points.lesions, "lesion");
  add(points.tissue, "tissue");
}

}  // namespace mammotwin
