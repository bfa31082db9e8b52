#include "segmentation/image/em_bias.h"

#include <algorithm>
#include <cmath>

#include "segmentation/image/smoothing.h"

namespace mammotwin {
namespace {

constexpr double block_mm = 4;
constexpr double least_variance = 0.05 * 0.05;  // of log intensity: below that noise rules
constexpr int wide_rounds = 6, narrow_rounds = 12;
constexpr double wide_mm = 60, narrow_mm = 25;

std::vector<IntensityClass> classes_at_quantiles(std::vector<float> values, int count) {
  std::sort(values.begin(), values.end());
  std::vector<IntensityClass> classes(count);
  for (int c = 0; c < count; ++c) {
    const double share = (c + 0.5) / count;
    classes[c].mean = values[static_cast<std::size_t>(share * (values.size() - 1))];
    classes[c].variance = 0.3 * 0.3;
    classes[c].weight = 1.0 / count;
  }
  return classes;
}

/// One round of expectation maximisation; leaves the residual and its weight (1 / variance).
class Round {
 public:
  Round(const Volume<float>& log_image, const Volume<float>& share)
      : y_(log_image), share_(share) {}

  void run(const Volume<float>& bias, std::vector<IntensityClass>& classes, Volume<float>& residual,
           Volume<float>& weight) const {
    const std::size_t count = classes.size();
    std::vector<double> sum(count, 0), sum_y(count, 0), sum_yy(count, 0), p(count);
    double total = 0;
    for (std::size_t v = 0; v < y_.values.size(); ++v) {
      residual.values[v] = weight.values[v] = 0;
      if (share_.values[v] < 0.5F) continue;
      const double y = y_.values[v] - bias.values[v];
      double norm = 1e-12;
      for (std::size_t c = 0; c < count; ++c) {
        const double d = y - classes[c].mean;
        p[c] = classes[c].weight * std::exp(-0.5 * d * d / classes[c].variance) /
               std::sqrt(classes[c].variance);
        norm += p[c];
      }
      double precision = 0, expected = 0;
      for (std::size_t c = 0; c < count; ++c) {
        p[c] /= norm;
        sum[c] += p[c], sum_y[c] += p[c] * y, sum_yy[c] += p[c] * y * y;
        precision += p[c] / classes[c].variance;
        expected += p[c] * classes[c].mean / classes[c].variance;
      }
      ++total;
      if (!(precision > 0)) continue;
      residual.values[v] = static_cast<float>(y - expected / precision + bias.values[v]);
      weight.values[v] = static_cast<float>(precision);
    }
    for (std::size_t c = 0; c < count; ++c) {
      if (!(sum[c] > 0)) continue;
      classes[c].mean = sum_y[c] / sum[c];
      classes[c].variance =
          std::max(least_variance, sum_yy[c] / sum[c] - classes[c].mean * classes[c].mean);
      classes[c].weight = sum[c] / total;
    }
  }

 private:
  const Volume<float>& y_;
  const Volume<float>& share_;
};

}  // namespace

float BiasEstimate::correction(const Eigen::Vector3d& x_in_lps) const {
  return std::exp(-interpolated(log_bias, x_in_lps));
}

BiasEstimate estimate_bias(const Volume<float>& image, const Volume<std::uint8_t>& mask,
                           int num_classes) {
  Volume<float> share;
  Volume<float> y = block_means(image, mask, block_mm, share);
  std::vector<float> inside;
  for (std::size_t v = 0; v < y.values.size(); ++v) {
    y.values[v] = std::log(std::max(y.values[v], 1e-6F));
    if (share.values[v] >= 0.5F) inside.push_back(y.values[v]);
  }
  BiasEstimate estimate{y.like<float>(0), y.like<float>(0), {}};
  if (inside.empty()) return estimate;
  estimate.classes = classes_at_quantiles(inside, num_classes);
  Volume<float> residual = y.like<float>(0), weight = residual;
  const Round round(y, share);
  for (int n = 0; n < wide_rounds + narrow_rounds; ++n) {
    round.run(estimate.log_bias, estimate.classes, residual, weight);
    estimate.log_bias = weighted_smoothed(residual, weight, n < wide_rounds ? wide_mm : narrow_mm);
    if (n + 1 == wide_rounds) estimate.wide_log_bias = estimate.log_bias;
  }
  std::sort(estimate.classes.begin(), estimate.classes.end(),
            [](const auto& a, const auto& b) { return a.mean < b.mean; });
  return estimate;
}

}  // namespace mammotwin
