#pragma once

#include "pipeline/report/patient_results.h"

namespace mammotwin {

/// Results of a made-up breast, as a finished chain leaves them: a dome on a flat chest wall with a
/// ball of fibroglandular tissue and two lesions, squeezed affinely in CC and MLO.
PatientResults fake_results(Side side);

}  // namespace mammotwin
