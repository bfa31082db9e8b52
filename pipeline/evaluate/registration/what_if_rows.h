#pragma once

#include <functional>
#include <nlohmann/json.hpp>
#include <string>

#include "pipeline/evaluate/cases/breasts_to_press.h"

namespace mammotwin {

/// A breast whose view is pressed again in other states.
struct WhatIfCase : BreastToPress {
  std::string view = "cc";
  int states = 6;
};

/// Takes the breast through the stages up to that view's compression. Then, at states drawn evenly
/// from the ranges of registration/search/what_if.h (all numbers at once, the same draws for every
/// breast), presses it anew and compares on the detector with what the models say that the page may
/// use: first order (`slopes`) and the quadratic through solves at the ends of each range
/// (`quadratic`). `add` gets a line for each model: how far lesions and tissue points in front of
/// the detector's edge lie off, over all states [mm]; how far they moved; states without an
/// equilibrium; CPU seconds of the model.
void add_what_if_rows(const WhatIfCase& asked,
                      const std::function<void(const nlohmann::json&)>& add);

}  // namespace mammotwin
