#pragma once

#include "fitting/mesh/hermite_mesh.h"
#include "pipeline/patient/compression_settings.h"
#include "pipeline/synthesize/patient.h"
#include "solver/press/compression_result.h"

namespace mammotwin {

/// A breast that hangs from the chest, pressed between two upright plates of a coil that take this
/// share off the width of its front half; `hanging` has prone gravity and friction, and no plates.
/// Throws std::runtime_error where they do not come together so far.
CompressionResult press_between_coil_plates(CompressionProblem hanging,
                                            CompressionSettings settings, double share);

/// The patient as MRI shows her whose breast went from `prone` to `pressed`, two configurations of
/// one mesh: image, lesions and nipple with the tissue; what lies within 60 mm beside it goes
/// along, less and less, and air before the skin with the skin. Tissue and labels stay those of
/// `prone`.
SyntheticPatient imaged_pressed(SyntheticPatient patient, const HermiteMesh& prone,
                                const HermiteMesh& pressed);

}  // namespace mammotwin
