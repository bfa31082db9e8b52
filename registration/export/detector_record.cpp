#include "registration/export/detector_record.h"

#include <nlohmann/json.hpp>

namespace mammotwin {

nlohmann::json detector_record(const Detector& detector) {
  nlohmann::json record{{"source_distance_mm", detector.source_distance_mm},
                        {"support_gap_mm", detector.support_gap_mm}};
  if (const auto& s = detector.slices)
    record["slices"] = {{"count", s->count},
                        {"spacing_mm", s->spacing_mm},
                        {"lowest_mm", s->lowest_mm},
                        {"first_at_support", s->first_at_support}};
  return record;
}

Detector read_detector_record(const nlohmann::json& record) {
  Detector detector;
  const auto read = [&](const char* key, double& number) {
    if (record.is_object() && record.contains(key) && record[key].is_number()) number = record[key];
  };
  read("source_distance_mm", detector.source_distance_mm);
  read("support_gap_mm", detector.support_gap_mm);
  if (record.is_object() && record.contains("slices")) {
    const nlohmann::json& s = record["slices"];
    detector.slices =
        TomosynthesisSlices{s.value("count", 0), s.value("spacing_mm", 1.),
                            s.value("lowest_mm", 0.), s.value("first_at_support", true)};
  }
  return detector;
}

}  // namespace mammotwin
