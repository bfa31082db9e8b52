#include "pipeline/synthesize/options.h"

#include <sstream>
#include <stdexcept>

#include "pipeline/synthesize/option_table.h"

namespace mammotwin {
namespace {

void check_range(const char* name, double value, double low, double high, const std::string& unit) {
  if (value >= low && value <= high) return;  // false for NaN
  std::ostringstream message;
  message << "synthetic patient: " << name << " is " << value << "; expected " << low << " to "
          << high << (unit == "-" ? "" : " " + unit);
  throw std::invalid_argument(message.str());
}

}  // namespace

void check(const PatientOptions& options) {
  visit_numbers(options,
                [](const char* name, double value, double low, double high, const char* unit,
                   const char*) { check_range(name, value, low, high, unit); });
  const AnatomyOptions& a = options.anatomy;
  if (a.lesion_max_mm < a.lesion_min_mm) {
    std::ostringstream message;
    message << "synthetic patient: lesion_max_mm is " << a.lesion_max_mm
            << "; expected at least lesion_min_mm, " << a.lesion_min_mm << " mm";
    throw std::invalid_argument(message.str());
  }
}

std::string name_of(Side side) { return side == Side::left ? "left" : "right"; }

std::string name_of(ScanContrast contrast) {
  return contrast == ScanContrast::fat_suppressed ? "fat_suppressed" : "not_suppressed";
}

}  // namespace mammotwin
