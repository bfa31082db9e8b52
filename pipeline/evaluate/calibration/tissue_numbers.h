#pragma once

#include <string>
#include <vector>

#include "pipeline/patient/compression_settings.h"

namespace mammotwin {

/// A positive number of the tissue, or of what holds it, that a calibration may move.
struct TissueNumber {
  std::string key;   ///< of patient.toml
  std::string unit;  ///< empty: none
  double least = 0, most = 0;
  double (*value)(const CompressionSettings&);
  void (*set)(CompressionSettings&, double);
};

/// All that can be calibrated. `materials.*.stiffening` is that of all three tissues.
const std::vector<TissueNumber>& tissue_numbers();

/// Those with these keys. Throws std::runtime_error naming one that is none, with those that are.
std::vector<TissueNumber> tissue_numbers(const std::vector<std::string>& keys);

}  // namespace mammotwin
