#include "pipeline/report/result_file.h"

#include <utility>

namespace mammotwin {
namespace {

constexpr std::pair<const char*, const char*> kByName[] = {
    {"lesions.csv", "lesions in MRI, CC and MLO as a table (spreadsheet)"},
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

constexpr std::pair<const char*, const char*> kByEnd[] = {
    {".mrk.json", "lesions and nipple as markups (3D Slicer)"},
    {".exf", "Hermite mesh (OpenCMISS-Zinc)"},
    {".png", "picture (a slide)"},
    {".nrrd", "field on a grid (3D Slicer)"},
};

}  // namespace

std::string described_file(const std::string& name) {
  for (const auto& [known, words] : kByName)
    if (name == known) return words;
  for (const auto& [end, words] : kByEnd)
    if (name.ends_with(end)) return words;
  return "";
}

}  // namespace mammotwin
