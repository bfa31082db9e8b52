#include "registration/export/detector_record.h"

#include <nlohmann/json.hpp>

namespace mammotwin {

nlohmann::json detector_record(const Detector& detector) {
  return {{"source_distance_mm", detector.source_distance_mm},
          {"support_gap_mm", detector.support_gap_mm}};
}

Detector read_detector_record(const nlohmann::json& record) {
  Detector detector;
  const auto read = [&](const char* key, double& number) {
    if (record.is_object() && record.contains(key) && record[key].is_number()) number = record[key];
  };
  read("source_distance_mm", detector.source_distance_mm);
  read("support_gap_mm", detector.support_gap_mm);
  return detector;
}

}  // namespace mammotwin
