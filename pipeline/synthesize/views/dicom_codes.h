#pragma once

#include <string>

#include "registration/export/dicom/dicom_object.h"

namespace mammotwin {

/// A sequence of one SNOMED CT code; returns its item.
DcmItem& put_code(DcmItem& object, const DcmTagKey& sequence, const char* value,
                  const char* meaning);

/// ViewCodeSequence of "cc" or "mlo", with no modifier.
void put_view_code(DcmItem& object, const std::string& view);

}  // namespace mammotwin
