#include "pipeline/report/result_file.h"

#include <utility>

namespace mammotwin {
namespace {

constexpr std::pair<const char*, const char*> kByName[] = {
    {"lesions.csv", "lesions in MRI, CC and MLO as a table (spreadsheet)"},
    {"lesions.csv.md", "what the table's columns mean"},
    {"segmentation.seg.nrrd", "tissue labels (3D Slicer)"},
    {"fractions.nrrd", "share of each tissue a voxel (3D Slicer)"},
    {"mri.nrrd", "MRI, bias-corrected (3D Slicer)"},
    {"prone.vtu", "prone breast with the fit's error (ParaView)"},
    {"unloaded.vtu", "breast free of stress (ParaView)"},
    {"cc.vtu", "breast compressed in CC (ParaView)"},
    {"mlo.vtu", "breast compressed in MLO (ParaView)"},
    {"cc_registered.vtu", "the same as laid on the CC detector (ParaView)"},
    {"mlo_registered.vtu", "the same as laid on the MLO detector (ParaView)"},
};

constexpr std::pair<const char*, const char*> kByBeginning[] = {
    {"ellipse_", "a lesion's search ellipse of that view, where it lies in the MRI (3D Slicer)"},
    {"lesions_prone", "lesions and nipple in the MRI (3D Slicer)"},
    {"lesions_unloaded", "lesions and nipple, free of stress (3D Slicer)"},
    {"lesions_standing", "lesions and nipple, standing (3D Slicer)"},
    {"lesions_supine", "lesions and nipple, lying on the back (3D Slicer)"},
    {"lesions_cc.", "lesions and nipple, compressed in CC (3D Slicer)"},
    {"lesions_mlo.", "lesions and nipple, compressed in MLO (3D Slicer)"},
    {"cc_from_prone", "displacement from a place in the MRI to CC (3D Slicer, ITK)"},
    {"mlo_from_prone", "displacement from a place in the MRI to MLO (3D Slicer, ITK)"},
    {"prone_from_cc", "displacement from a place in CC back to the MRI (3D Slicer, ITK)"},
    {"prone_from_mlo", "displacement from a place in MLO back to the MRI (3D Slicer, ITK)"},
    {"mri_in_cc", "the MRI as compressed in CC (3D Slicer)"},
    {"mri_in_mlo", "the MRI as compressed in MLO (3D Slicer)"},
    {"simulated_", "the view as simulated (a slide)"},
};

constexpr std::pair<const char*, const char*> kByEnd[] = {
    {".nii.gz", "image for other tools (NIfTI)"}, {".mrk.json", "points (3D Slicer)"},
    {".exf", "Hermite mesh (OpenCMISS-Zinc)"},    {".png", "picture (a slide)"},
    {".nrrd", "field on a grid (3D Slicer)"},
};

}  // namespace

std::string described_file(const std::string& name) {
  for (const auto& [known, words] : kByName)
    if (name == known) return words;
  for (const auto& [beginning, words] : kByBeginning)
    if (name.starts_with(beginning)) return words;
  for (const auto& [end, words] : kByEnd)
    if (name.ends_with(end)) return words;
  return "";
}

}  // namespace mammotwin
