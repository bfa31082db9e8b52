#pragma once

#include "fitting/mesh/hermite_mesh.h"
#include "pipeline/synthesize/patient.h"

namespace mammotwin {

/// The patient as MRI shows her whose breast went from `prone` to `pressed`, two configurations of
/// one mesh: image, lesions and nipple with the tissue. Tissue and labels stay those of `prone`.
/// Where the breast was and is no more, there is air; what lies more than 12 mm outside it (the
/// other breast, the chest) stays.
SyntheticPatient imaged_pressed(SyntheticPatient patient, const HermiteMesh& prone,
                                const HermiteMesh& pressed);

}  // namespace mammotwin
