#pragma once

#include <filesystem>
#include <string>

#include "pipeline/synthesize/anatomy.h"
#include "pipeline/synthesize/scan.h"
#include "segmentation/segmentation.h"

namespace mammotwin {

/// What is true of a synthetic patient. Volumes are sums of the voxels' fractions inside the
/// breast's region; skin is counted apart from fat.
struct Truth {
  BreastRegion region;
  double breast_ml = 0, fat_ml = 0, fibroglandular_ml = 0, skin_ml = 0;
  double skin_thickness_mm = 0;
  std::vector<Lesion> lesions;
  Eigen::Vector3d nipple_in_lps = Eigen::Vector3d::Zero();  ///< tip of the nipple [mm]
  double cc_extent_mm = 0, mlo_extent_mm = 0;  ///< along the beam, in front of the plates' edge
  double shading_ratio = 1;
};

struct SyntheticPatient {
  PatientOptions options;
  TissueMap tissue;
  Volume<std::uint8_t> labels;  ///< both sides, values of segmentation/segmentation.h
  Truth truth;
  Scan scan;
};

/// Label of the material that fills most of each voxel; both sides.
Volume<std::uint8_t> label_map(const TissueMap& tissue);

/// Region, volumes and lesions (materials' numbers 0 to `lesions` - 1) of one side.
Truth measure_truth(const TissueMap& tissue, const Volume<std::uint8_t>& labels, Side side,
                    int lesions);

/// Patient as `segment` would hand it on if it made no mistake: labels of one half, fractions,
/// region, lesions and nipple.
Segmentation true_segmentation(const TissueMap& tissue, const Volume<std::uint8_t>& labels,
                               const Truth& truth);

/// The whole patient. Same options, same bytes. Throws std::invalid_argument for options out of
/// range or that cannot be met together.
SyntheticPatient make_patient(const PatientOptions& options);

/// The patient without its image: for stages that start from a segmentation.
SyntheticPatient make_patient_without_scan(const PatientOptions& options);

}  // namespace mammotwin
