#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "segmentation/label_maps/label_values.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

/// One breast of a label map made elsewhere.
struct LabelMapBreast {
  std::string exam;  ///< the file's name up to "_labels"
  Side side = Side::left;
  std::filesystem::path file;
};

/// Both breasts of every label_maps/*_labels.nii.gz below `cases`, in the order of their names.
std::vector<LabelMapBreast> label_map_breasts(const std::filesystem::path& cases);

/// What the values of those maps mean (the cases' README).
LabelValues label_map_values();

/// The contents of a folder in the order of their names; empty where there is no such folder.
std::vector<std::filesystem::path> sorted_entries(const std::filesystem::path& folder);

}  // namespace mammotwin
