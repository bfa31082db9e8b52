#pragma once

#include <filesystem>
#include <map>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "fitting/mesh/mesh_file.h"
#include "registration/export/lesion_table.h"
#include "registration/mammogram/mammogram_findings.h"
#include "registration/search/search_ellipse.h"
#include "registration/search/what_if.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

/// A stage's sidecar, in the order in which stages run.
struct StageRecord {
  std::string product;  ///< "prone.vtu"
  nlohmann::json sidecar;
};

struct ViewResult {
  MeshFile file;  ///< shows the compressed configuration
  CompressedView view;
  Detector detector;
  std::optional<ViewUncertainty> uncertainty = {};  ///< where `register` left it
  WhatIfShapes what_if = {};                        ///< likewise
};

/// A view's real mammogram, on the detector that the view was registered with.
struct RealMammogram {
  std::string view;      ///< "cc" or "mlo"
  MammogramImage image;  ///< of a tomosynthesis volume the mean of its slices
  Detector detector;     ///< with its pixel grid
  std::optional<MammogramFindings> findings{};  ///< what the search was told
  std::map<int, MammogramImage> slices{};       ///< those that lesions are predicted in
};

/// Whatever a patient's result folder holds; a stage that was refused has left only its sidecar.
struct PatientResults {
  std::string patient;
  std::vector<StageRecord> stages;
  std::optional<Volume<float>> mri;
  std::optional<Segmentation> segmentation;
  std::optional<MeshFile> prone;
  std::optional<HermiteMesh> unloaded;  ///< the same elements, free of stress
  std::vector<ViewResult> views;
  std::vector<LesionRow> rows;
  std::vector<RealMammogram>
      mammograms;                  ///< those that the patient's file names and that could be read
  std::vector<std::string> files;  ///< names of the folder's files, sorted
  std::vector<std::string> notes;  ///< products that exist and could not be read, with the reason

  /// Lesions and nipple in the prone MRI: of the segmentation, else of the lesion table.
  std::vector<Landmark> lesions() const;
  std::optional<Eigen::Vector3d> nipple() const;
  const ViewResult* view(const std::string& name) const;
  const RealMammogram* mammogram(const std::string& view) const;
  const nlohmann::json* sidecar(const std::string& product) const;
  /// The first reason why a view's mammogram was not registered; empty where it was, or is none.
  std::string not_registered(const std::string& view) const;
  /// The first reason why a view that was registered is to be looked at, else empty.
  std::string registered_in_doubt(const std::string& view) const;
};

/// "cc" -> "CC", "mlo" -> "MLO", "mri" -> "MRI".
std::string title_of_view(const std::string& name);

/// Never throws for a missing or broken product: it is absent and, if broken, noted.
/// Throws std::runtime_error if the folder itself is missing.
PatientResults read_patient_results(const std::filesystem::path& folder);

}  // namespace mammotwin
