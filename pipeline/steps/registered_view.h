#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "pipeline/frame/products.h"
#include "pipeline/patient/compression_settings.h"
#include "registration/search/search_ellipse.h"
#include "registration/view/project_lesions.h"
#include "registration/view/simulated_mammogram.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

/// The breast prone and compressed in one view, ready to be looked at from its detector.
struct RegisteredView {
  MeshFile file;  ///< what was read
  HermiteMesh prone, compressed;
  ViewProjection projection;
  /// The same breast in other states that unload found, by name: "unloaded", "standing", "supine".
  std::map<std::string, HermiteMesh> states;
  std::optional<ViewUncertainty> uncertainty;  ///< of a view that register has searched

  /// Covariance of a material point on the detector [mm^2]; empty without an uncertainty.
  std::optional<Eigen::Matrix2d> covariance(const MeshPoint& point) const;

  /// The same in the model's own picture (without_placement).
  std::optional<Eigen::Matrix2d> covariance_in_picture(const MeshPoint& point) const;
};

/// Reads what compress wrote (cc.vtu), or register (cc_registered.vtu).
/// Throws std::runtime_error naming the file and what is missing in it.
RegisteredView read_registered_view(const std::string& name, const std::filesystem::path& path,
                                    const ViewSettings& settings);

/// What `read_registered_view` reads back: the registered mesh with its view, its uncertainty (the
/// breast with each state's number varied, "varied_roll_deg" ...) and where the baseline lies.
void write_registered_view(const std::filesystem::path& path, const RegisteredView& view);

/// What the report needs to draw the view on its detector.
nlohmann::json detector_json(const Detector& detector);

/// For a view "cc": cc_from_prone.nrrd and prone_from_cc.nrrd, simulated_cc.png and, with an MRI,
/// mri_in_cc.nrrd; the fields' composition error goes to `quality`. Returns the view as shown.
DetectorImage write_view_files(const RegisteredView& view, const Segmentation& segmentation,
                               const std::optional<Volume<float>>& mri, Products& products,
                               nlohmann::json& quality);

/// Table of target registration errors for a file of landmark pairs.
/// Throws std::runtime_error where a view that has marks has no pixel spacing.
std::string landmark_errors(const std::filesystem::path& pairs, const RegisteredView& cc,
                            const RegisteredView& mlo);

}  // namespace mammotwin
