#pragma once

#include <cstdint>

#include "segmentation/lesion/lesion.h"

namespace mammotwin {

/// Half maximum, iterated, in one crop of the image, round one point; lesions are bright in it.
class HalfMaximum {
 public:
  HalfMaximum(const Volume<float>& image, const Volume<std::uint8_t>& allowed,
              const Eigen::Vector3d& point, const LesionSearch& search)
      : image_(image), allowed_(allowed), point_(point), search_(search) {}

  /// The lesion's voxels; its brightness, background and inscribed radius go to `lesion`.
  Volume<std::uint8_t> run(FoundLesion& lesion);

  /// After it: what is over a share of the lesion's contrast, opened a little less: the part that
  /// holds its core.
  Volume<std::uint8_t> at_share(const FoundLesion& lesion, double share) const;

 private:
  Volume<std::uint8_t> what_is_over(double threshold) const;
  /// What is over half of the maximum, opened: the part that holds the core, with its lobes or not.
  Volume<std::uint8_t> grow(FoundLesion& lesion, bool with_lobes);
  /// Parts not far from what was kept of the lesion that are smaller, and as bright.
  Volume<std::uint8_t> lobes_of(const Volume<std::uint8_t>& mask, const Volume<std::uint8_t>& kept,
                                double most_gap_mm, const FoundLesion& lesion) const;
  /// Climbs from the core to the deepest place within its own depth, and moves the core there.
  double deepest_near_core(const Volume<float>& depth);
  void measure(const Volume<std::uint8_t>& mask, FoundLesion& lesion) const;

  const Volume<float>& image_;
  const Volume<std::uint8_t>& allowed_;
  Eigen::Vector3d point_;
  const LesionSearch& search_;
  std::size_t core_ = 0;
};

}  // namespace mammotwin
