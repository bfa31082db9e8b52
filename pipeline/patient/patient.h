#pragma once

#include <Eigen/Core>
#include <deque>
#include <filesystem>
#include <map>
#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>
#include <vector>

#include "fitting/scan/scanned_breast.h"
#include "pipeline/frame/settings_file.h"
#include "pipeline/patient/compression_settings.h"
#include "pipeline/patient/gravity_settings.h"
#include "pipeline/patient/lesion_entry.h"
#include "pipeline/patient/registration_settings.h"
#include "segmentation/segment.h"

namespace mammotwin {

/// Everything that patient.toml may say: one options struct a stage, filled from one table of
/// settings (`declare`), so that the file, the command lines and the sidecars agree.
class Patient : public SettingsFile {
 public:
  Patient() = default;
  Patient(const Patient&) = delete;  // settings point into it
  Patient& operator=(const Patient&) = delete;

  std::string subject() const override { return "patient"; }

  /// Enters every key of patient.toml in the table.
  void declare(Settings& settings) override;

  /// Reads patient.toml. Throws std::runtime_error naming file and key where the file is missing,
  /// is not TOML, has an unknown key (the nearest known one is named) or a value out of range.
  void read(const std::filesystem::path& file, Settings& settings) override;

  /// The same, for who needs no table of settings afterwards.
  void read(const std::filesystem::path& file);

  /// The patient's folder, as its name: "042"; empty without a patient.toml.
  std::string name() const;

  /// Inputs of `segment` with paths resolved. Throws std::runtime_error where neither an MRI nor a
  /// label map is named and there is no folder `mri`.
  SegmentInput segment_input() const;
  /// Every file or folder that `segment_input` names.
  std::vector<std::filesystem::path> segment_files() const;

  /// The scanned skin that stands for an image, with its path resolved; empty where there is none.
  std::optional<std::filesystem::path> scan_file() const;

  /// How the patient lay when imaged: as the settings say; else none for a scan, which is free of
  /// stress as it stood; else as the image's header says, prone where it does not.
  /// `patient_position`: DICOM's code ("HFP": head first, prone); empty where it is not known.
  Pose imaged_pose(const std::string& patient_position) const;
  /// How it is read. Throws std::runtime_error where half of a base plane is given.
  ScannedSkinOptions scan_options() const;

  SegmentOptions segment;
  bool nifti = false;  ///< `segment` writes labels and image as NIfTI, too
  FitOptions fit;
  CompressionSettings compression;
  GravitySettings gravity;
  RegistrationSettings registration;
  ViewSettings cc = ViewSettings::at(0), mlo = ViewSettings::at(45);

  /// `unload.second_state` with its path resolved.
  std::optional<std::filesystem::path> second_state() const;

  /// "cc" or "mlo"; std::logic_error otherwise.
  const ViewSettings& view(const std::string& name) const;

  /// Throws std::runtime_error naming the key of the first file or folder that is named and is not
  /// there, so that nothing runs before all of them are.
  void require_files() const;

  std::vector<NamedFile> named_files() const override;
  bool keeps_names() const override { return keeps_names_; }

  Settings list_settings() const override;

  /// Parameters that come in lists (lesions) below these prefixes, in the sidecar's form.
  nlohmann::json list_parameters(const std::vector<std::string>& prefixes) const override;

  /// A path of patient.toml, which may be relative to it.
  std::filesystem::path resolve(const std::filesystem::path& path) const override;

 private:
  void declare_inputs(Settings& settings);
  void declare_scan(Settings& settings);
  void declare_segment(Settings& settings);
  void declare_fit(Settings& settings);
  void read_lesions(const std::string& file, const nlohmann::json& list);
  LesionSeed seed_of(const LesionEntry& entry) const;
  LabelValues label_values() const;

  std::filesystem::path file_;
  bool keeps_names_ = false;
  std::optional<Side> side_;
  std::optional<std::filesystem::path> mri_, pre_, compared_, labels_, scan_, nipple_markups_,
      wall_markups_, region_markups_;
  ScannedSkinOptions scan_options_;
  std::optional<Eigen::Vector3d> scan_up_;
  std::optional<std::string> series_, pre_series_, compared_series_;
  std::optional<bool> fat_suppressed_;
  std::map<ForeignTissue, std::vector<int>> label_values_;
  std::optional<Eigen::Vector3d> nipple_lps_mm_;
  std::deque<LesionEntry> lesions_;  // settings point into it while a list is read
};

}  // namespace mammotwin
