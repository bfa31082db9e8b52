#pragma once

#include "pipeline/frame/settings.h"

namespace mammotwin {

/// What patient.toml says of registration.
struct RegistrationSettings {
  bool search = true;         ///< sensitivities, search against mammograms, ellipses
  bool dicom_export = false;  ///< GSPS, SR and MG in a folder dicom
};

inline void declare_registration(Settings& s, RegistrationSettings& r) {
  s.flag("register.search", r.search,
         "solves for the views' sensitivities: search against mammograms, search ellipses");
  s.flag("dicom_export", r.dicom_export,
         "writes DICOM objects that carry the mammograms' patient and study attributes");
}

}  // namespace mammotwin
