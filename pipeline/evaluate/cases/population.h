#pragma once

#include <string>

#include "pipeline/synthesize/options.h"

namespace mammotwin {

/// One synthetic breast of the population and how hard each view presses it.
struct SyntheticBreast {
  int number = 0;
  std::string name;  ///< "synthetic-017"
  bool hard = false;
  PatientOptions patient;      ///< its breast; the MLO angle stands in `patient.views`
  double stiffness_ratio = 1;  ///< fibroglandular over fat
  double cc_fraction = 0, mlo_fraction = 0;  ///< 1 - thickness asked / free extent
};

/// Breast `number` (from 0) of the population, by the law of pipeline/evaluate/README.md. Depends
/// on the number alone, so that a larger population begins with the smaller one. Every fourth
/// breast is `hard`: both its views are asked for more than 0.6 at a ratio of 1:5 and above.
///
/// `attempt` (from 0) redraws the build (chest, shape, places of gland and lesions) and nothing
/// that the law promises: not every chest can carry every breast.
SyntheticBreast draw_breast(int number, int attempt = 0);

}  // namespace mammotwin
