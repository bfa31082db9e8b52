#pragma once

#include <string>

namespace mammotwin {

/// Why a text cannot name a lesion wherever names stand (tables, pages, scenes, DICOM), as "holds a
/// control character"; empty: it can.
std::string fault_of_lesion_id(const std::string& id);

}  // namespace mammotwin
