#pragma once

#include <functional>
#include <nlohmann/json.hpp>

#include "pipeline/evaluate/cases/breasts_to_press.h"

namespace mammotwin {

/// Another program's mesh of a breast's segmentation, made before.
struct OtherMesh {
  std::filesystem::path mesh;
  std::vector<std::string> views = {"cc", "mlo"};
};

/// Segments and fits the breast, presses the shape as it was imaged with this mesh and with the
/// other one, and gives `add` a line a view: `lesion_median_mm`, `lesion_max_mm`,
/// `tissue_median_mm`, `tissue_max_mm` (how far lesions and 50 points come to lie from where the
/// other mesh puts them, relative to the nipple), `force_N`, `force_change` [fraction of the
/// other's], `elements` and `other_elements`. What found no equilibrium, or a mesh that is not of
/// these labels, has a `reason` and nulls.
void add_other_mesh_rows(const BreastToPress& breast, const OtherMesh& other,
                         const std::function<void(const nlohmann::json&)>& add);

}  // namespace mammotwin
