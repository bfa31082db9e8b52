#pragma once

#include "pipeline/compression_settings.h"
#include "pipeline/frame/products.h"
#include "registration/project_lesions.h"
#include "segmentation/tissue.h"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <map>
#include <optional>
#include <string>

namespace mammotwin {

/// The breast prone and compressed in one view, ready to be looked at from its detector.
struct RegisteredView {
  HermiteMesh prone, compressed;
  ViewProjection projection;
  /// The same breast in other states that unload found, by name: "unloaded", "standing", "supine".
  std::map<std::string, HermiteMesh> states;
};

/// Reads what compress wrote. Throws std::runtime_error naming the file and what is missing in it.
RegisteredView read_registered_view(const std::string& name, const std::filesystem::path& path,
                                    const ViewSettings& settings);

/// What the report needs to draw the view on its detector.
nlohmann::json detector_json(const Detector& detector);

/// For a view "cc": cc_from_prone.nrrd and prone_from_cc.nrrd, simulated_cc.png and, with an MRI,
/// mri_in_cc.nrrd; the fields' composition error goes to `quality`.
void write_view_files(const RegisteredView& view, const Segmentation& segmentation,
                      const std::optional<Volume<float>>& mri, Products& products,
                      nlohmann::json& quality);

/// Table of target registration errors for a file of landmark pairs.
/// Throws std::runtime_error where a view that has marks has no pixel spacing.
std::string landmark_errors(const std::filesystem::path& pairs, const RegisteredView& cc,
                            const RegisteredView& mlo);

}  // namespace mammotwin
