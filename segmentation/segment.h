#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "segmentation/label_maps/label_values.h"
#include "segmentation/segment_quality.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

/// Where one lesion is, in one of four ways: a point or a sphere, the first control point of a
/// markups file, or a value in a label map.
struct LesionSeed {
  std::string id;
  std::optional<Eigen::Vector3d> point_in_lps;     ///< [mm]
  std::optional<double> radius_mm;                 ///< the lesion is this sphere round the point
  std::optional<std::filesystem::path> markups;    ///< .mrk.json, in LPS or RAS
  std::optional<std::filesystem::path> label_map;  ///< made elsewhere
  std::optional<std::uint16_t> label_value;        ///< in that map; 1 where not given
};

/// What a segmentation is made from: an MRI, a label map made elsewhere, or both (the labels are
/// then taken as they are and the MRI is handed on beside them).
struct SegmentInput {
  std::optional<std::filesystem::path> mri;
  std::optional<std::string> series;  ///< as in read_dicom_series.h
  /// The image before contrast agent: a file or folder of its own, or a series of `mri`'s folder.
  std::optional<std::filesystem::path> pre;
  std::optional<std::string> pre_series;
  /// Another image of the same study, whose chest wall must be the same: a file or folder of its
  /// own, or a series of `mri`'s folder. Where neither is given and a series of the folder was
  /// chosen, one of the others.
  std::optional<std::filesystem::path> compared;
  std::optional<std::string> compared_series;
  std::optional<bool> fat_suppressed;  ///< decided from the image where not given
  std::optional<std::filesystem::path> label_map;
  /// Empty: by the names of its segments where it is a .seg.nrrd, else those of segmentation.h.
  LabelValues label_values;
  std::optional<Side> side;  ///< the lesions' side where not given
  std::vector<LesionSeed> lesions;
  std::optional<Eigen::Vector3d> nipple_in_lps;  ///< [mm]
  std::optional<std::filesystem::path> nipple_markups;
  std::optional<std::filesystem::path> wall_markups;  ///< the muscle's front, drawn in a few slices
  std::optional<std::filesystem::path> region_markups;  ///< the breast's region: an ROI
};

enum class LesionMethod {
  half_maximum,   ///< iterated; best on real lesions (the default)
  random_walker,  ///< sharper where gland is mottled; too small on real lesions
};

struct SegmentOptions {
  /// Skin thickness [mm], 0.5 to 5, where it is known; measured otherwise.
  std::optional<double> skin_thickness_mm;
  LesionMethod lesion_method = LesionMethod::half_maximum;
  /// A lesion reaches at most this far from its point [mm], 5 to 60.
  double lesion_reach_mm = 50;
  /// Stiffness of the chest wall's search, 0.01 to 1: cost of a jump between rays [per mm^2].
  double wall_stiffness = 0.08;
};

struct SegmentResult {
  Segmentation segmentation;
  Volume<float> image;  ///< bias corrected, on the grid of the labels; empty without an MRI
  SegmentQuality quality;
  std::vector<std::filesystem::path> files;  ///< what was read, for the record of inputs
  /// Doubts that wait for the region; empty without an MRI.
  std::function<void(const BreastRegion&, SegmentQuality&)> judge_in_region;
};

/// Told how far the work is, fraction in [0, 1], and what is being done; may be empty.
using SegmentProgress = std::function<void(double fraction, const std::string& what)>;

/// Throws std::runtime_error or std::invalid_argument with a complete message where the input
/// cannot serve; status `refused` in the quality is for an image that could be read and segmented,
/// but must not be believed.
SegmentResult segment(const SegmentInput& input, const SegmentOptions& options,
                      const SegmentProgress& progress = {});

}  // namespace mammotwin
