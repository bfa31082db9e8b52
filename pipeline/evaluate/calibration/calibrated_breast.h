#pragma once

#include <array>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "pipeline/evaluate/calibration/tissue_numbers.h"

namespace mammotwin {

/// What is compared with women's breasts: the nipple's way to the side and back, the tissue's way,
/// its distance from the ribs supine [mm] (SupinePoints), and log of the paddle's force in CC [N]
/// at the breast's thickness.
enum BreastFigure { kLateral, kPosterior, kLandmark, kRibs, kLogForce, kBreastFigures };
using BreastFigures = std::array<double, kBreastFigures>;

/// One breast as imaged that is unloaded, laid on its back and pressed with given numbers.
class CalibratedBreast {
 public:
  /// `folder`: segmentation.seg.nrrd, fractions.nrrd, prone.vtu and patient.toml, which says how
  /// thick the breast is in CC. Throws std::runtime_error where one cannot be read.
  explicit CalibratedBreast(const std::filesystem::path& folder);
  ~CalibratedBreast();
  CalibratedBreast(CalibratedBreast&&) noexcept;

  const std::string& name() const { return name_; }
  /// In CC.
  double thickness_mm() const;
  /// What patient.toml says of tissue.
  const CompressionSettings& settings() const;

  /// Figures with these values of `numbers`, which are kept for `slopes`. Throws std::runtime_error
  /// with the reason where there is no equilibrium.
  BreastFigures solve(const std::vector<TissueNumber>& numbers, const std::vector<double>& values);

  /// Derivatives of the figures by the logarithm of each number, where they were last solved: what
  /// gravity does by implicit differentiation (PoseEquilibria), the force from compressions that
  /// begin with the solved one, or anew where one finds no way from there.
  std::vector<BreastFigures> slopes() const;

 private:
  struct Solved;
  struct Loaded;
  CompressionSettings settings_at(std::size_t number, double log_change) const;

  std::string name_;
  std::unique_ptr<Loaded> loaded_;
  std::unique_ptr<Solved> solved_;
};

}  // namespace mammotwin
