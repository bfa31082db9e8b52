#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "pipeline/synthesize/patient.h"

namespace mammotwin {

/// A breast whose truth is known, imaged by the simulator when asked for.
struct SegmentationCase {
  std::string name;  ///< "seed-1004", "Exam_07-left-not_suppressed", with "-pre_post" if two images
  ScanContrast contrast = ScanContrast::fat_suppressed;
  std::function<SyntheticPatient()> make;
  std::function<SyntheticPatient()> make_pre = {};  ///< before contrast agent; empty if not imaged
  bool varied = false;                              ///< one of varied_cases
};

/// Patients drawn from seeds 1000, 1001, ...: they differ in everything that the study of
/// segmentation found to matter, spread evenly by steps that do not divide each other.
std::vector<SegmentationCase> drawn_cases(int count);

/// Both breasts of every label map below `cases`, each in both contrasts: noise 3 to 8 % of fat,
/// shading over 1:5, voxels of 1.2 mm, 10 to 25 mm of muscle in front of a filled thorax.
///
/// The unsuppressed ones stand there again (`pre_post`), imaged before and after contrast agent:
/// only then is their lesion 1.78 times as bright as gland, and brighter than before.
std::vector<SegmentationCase> label_map_cases(const std::filesystem::path& cases);

/// Some of these breasts imaged as other scanners and patients would have it: muscle of 0.6 to 2.8
/// of fat, heart and liver brighter than muscle, ghosts beside the body, breasts pressed flat
/// between coil plates, voxels of 0.75 and 1.3 mm, vessels of 2.5 to 4 times fat.
std::vector<SegmentationCase> varied_cases(const std::filesystem::path& cases);

}  // namespace mammotwin
