#pragma once

#include <filesystem>
#include <functional>
#include <nlohmann/json_fwd.hpp>
#include <vector>

#include "pipeline/report/drawing/picture.h"

namespace mammotwin {

/// A skin known by formula, without noise and holes: the gel breast's, whose tip is C2 only
/// (exp(-rho^3)) with a nipple 4 mm wide on it; a smooth bell of its size; or such a bell on a box,
/// to which the mesh is fitted by distance alone (fit_box).
enum class KnownSkin { gel_breast, bell, bell_on_box };

/// A fit to a known skin with n x n x 2 elements, on the box n x n x 1.
struct FitAccuracy {
  KnownSkin skin = KnownSkin::gel_breast;
  int columns = 0;
  double element_mm = 0;  ///< root of the skin's area over n²
  double rms_mm = 0;      ///< points of the true skin to the mesh's
};

/// Fits by the stage have as little smoothing and shape energy as it allows; counts without a valid
/// mesh are left out.
std::vector<FitAccuracy> fit_convergence(const std::filesystem::path& scan,
                                         const std::vector<int>& columns,
                                         const std::function<void(const std::string&)>& say);

nlohmann::json to_json(const std::vector<FitAccuracy>& accuracies);

/// Error against columns, with the fourth power of the element size, the order of cubics, beside
/// it.
Picture fit_convergence_picture(const std::vector<FitAccuracy>& accuracies);

}  // namespace mammotwin
