#pragma once

#include <Eigen/Core>
#include <filesystem>
#include <string>
#include <vector>

#include "pipeline/evaluate/cases/label_maps.h"

namespace mammotwin {

/// `side = "left"` of a patient.toml.
std::string side_toml(Side side);
/// [labels] of a patient.toml whose segmentation is a label map made elsewhere.
std::string labels_toml(const std::filesystem::path& label_map);

/// One breast of a folder of cases: a label map's, or that of a patient's MRI on the side of the
/// radiologist's first lesion.
struct RealBreast {
  std::string name;
  Side side = Side::left;
  std::filesystem::path image;  ///< the label map, or the MRI's folder or file
  bool is_label_map = true;
  std::vector<Eigen::Vector3d> lesions = {};  ///< [mm, LPS], of an MRI
  std::string preset = {};                    ///< materials.preset, where one is asked for
};

/// The patient.toml of that breast.
std::string patient_toml_of(const RealBreast& breast);

/// "Exam_02-left".
std::string name_and_side(const RealBreast& breast);

/// label_maps/*_labels.nii.gz, both sides of each, then mri/ of each folder that holds a
/// radiologist's contours, lesions_radiologist.json.
std::vector<RealBreast> real_breasts(const std::filesystem::path& cases);
/// Those of them that --only names. Throws std::runtime_error where there is none.
std::vector<RealBreast> asked_breasts(const std::filesystem::path& cases,
                                      const std::vector<std::string>& only);

}  // namespace mammotwin
