#pragma once

#include <array>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "pipeline/evaluate/cases/label_maps.h"
#include "pipeline/evaluate/cases/population.h"
#include "pipeline/patient/tissue_presets.h"
#include "pipeline/synthesize/patient.h"

namespace mammotwin {

/// A breast whose compressions are evaluated, in a folder of its own that ends up holding all that
/// `mammotwin-compress` needs to do one of them again: segmentation.seg.nrrd, fractions.nrrd,
/// prone.vtu and patient.toml. `about.json` there says what they were made from.
struct EvaluatedBreast {
  std::string name;
  std::filesystem::path folder;
  std::optional<SyntheticBreast> synthetic;  ///< drawn, or
  std::optional<LabelMapBreast> label_map;   ///< of a patient
  std::string preset = kDefaultTissue;       ///< materials.preset
  bool unload = false;                       ///< pressed free of gravity, not as imaged

  /// What is pressed.
  std::filesystem::path mesh() const { return folder / (unload ? "unloaded.vtu" : "prone.vtu"); }
};

/// What the plates are asked for in one view.
struct AskedView {
  std::string view;  ///< "cc", "mlo"
  double angle_deg = 0;
  double free_thickness_mm = 0;
  double thickness_mm = 0;
};

struct PreparedBreast {
  nlohmann::json facts;  ///< for the breast's rows: side, volume_ml, stiffness_ratio, ...
  std::string reason;    ///< why there is no mesh; empty where there is
  std::array<AskedView, 2> views{{{.view = "cc"}, {.view = "mlo"}}};
  bool usable() const { return reason.empty(); }
};

/// The drawn breast on the first chest that can carry it, with its MRI or without.
SyntheticPatient make_drawn(const SyntheticBreast& drawn, bool scanned);

/// A drawn breast as `segment` would hand it on if it made no mistake: segmentation.seg.nrrd and
/// fractions.nrrd in `folder`. Returns facts of it: side, volume_ml, density, ptosis, lesions.
nlohmann::json segment_drawn(const SyntheticBreast& drawn, const std::filesystem::path& folder);

/// Makes what the breast's folder lacks. Segmentation and mesh are kept where `about.json` says
/// that they were made from the same; a new program alone does not make them again, `again` does.
/// Drawn breasts are asked for their fraction of the free extent, patients' for 55 mm.
PreparedBreast prepare_breast(const EvaluatedBreast& breast, bool again);

}  // namespace mammotwin
