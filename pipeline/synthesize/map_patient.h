#pragma once

#include <filesystem>

#include "pipeline/synthesize/map_body.h"
#include "pipeline/synthesize/patient.h"

namespace mammotwin {

/// One breast of a real body, imaged by the simulator: anatomy of a label map, intensities, coil,
/// blur and noise of ScanOptions. The truth is that of the materials, as for drawn patients; the
/// nipple and the skin's thickness are not known (NaN), and columns without muscle end where the
/// map's tissue does (the image goes on). Lesions of the side are numbered from 0, the largest
/// first.
SyntheticPatient make_map_patient(const MapBody& body, Side side, const ScanOptions& scan,
                                  std::uint64_t seed);

}  // namespace mammotwin
