#include <nlohmann/json.hpp>

#include "pipeline/patient/patient.h"
#include "tests/fuzz/readers/reader.h"

namespace mammotwin::fuzz {

void patient_toml(const std::string& bytes) {
  Patient patient;
  Settings settings;
  patient.declare(settings);
  patient.read(fuzzed_file("patient.toml", bytes), settings);
  settings.parameters({""});
  patient.list_parameters({"lesions."});
  patient.named_files();
}

}  // namespace mammotwin::fuzz
