#pragma once

#include <functional>

#include "pipeline/report/patient_results.h"

namespace mammotwin {

/// Where to write a file that will be called `name` beside the scene.
using FileWriter = std::function<std::filesystem::path(const std::string& name)>;

/// A 3D Slicer scene of whatever there is: MRI, segmentation, lesions and nipple in every state,
/// the MRI as compressed, displacement fields as transforms that bring the MRI into a view, and the
/// breast's surface in every state, which it writes as scene_<state>.vtp. Returns the scene's text
/// (.mrml), to be written beside the results' other files.
std::string slicer_scene(const PatientResults& results, const FileWriter& write);

}  // namespace mammotwin
