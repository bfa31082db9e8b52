#pragma once

#include <cstdint>
#include <vector>

#include "segmentation/image/volume.h"

namespace mammotwin {

/// One tissue class of log intensity.
struct IntensityClass {
  double mean = 0;  ///< of log(intensity / bias)
  double variance = 0;
  double weight = 0;  ///< share of the voxels
};

struct BiasEstimate {
  Volume<float> log_bias;               ///< on a coarse grid of about 4 mm
  Volume<float> wide_log_bias;          ///< after the rounds with 60 mm: keeps what is local
  std::vector<IntensityClass> classes;  ///< in order of their means

  /// exp(-log_bias), interpolated: what to multiply the image by at a point.
  float correction(const Eigen::Vector3d& x_in_lps) const;
};

/// A smooth log field and `num_classes` classes of log intensity, found in turn by expectation
/// maximisation: log I = log_bias + class mean + noise, after Wells et al., IEEE TMI 15 (1996),
/// 429-442. The field is a weighted Gaussian mean of the residual, 60 mm wide to start with and
/// 25 mm at the end. Coarse: good enough to find the chest wall.
BiasEstimate estimate_bias(const Volume<float>& image, const Volume<std::uint8_t>& mask,
                           int num_classes);

}  // namespace mammotwin
