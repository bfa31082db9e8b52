#include "pipeline/steps/solution_record.h"

#include <array>

#include "fitting/mesh/metadata_field.h"

namespace mammotwin {
namespace {

constexpr const char* kPressure = "pressure_kpa";
constexpr const char* kPlates = "plates";

/// The field `plates`, number by number.
constexpr std::array kPlateNumbers = {&SolutionRecord::support_height_mm,
                                      &SolutionRecord::paddle_height_mm,
                                      &SolutionRecord::edge_mm,
                                      &SolutionRecord::lateral_middle_mm,
                                      &SolutionRecord::penalty_kpa_per_mm,
                                      &SolutionRecord::target_thickness_mm};

}  // namespace

void write_solution(const SolutionRecord& solution, MeshFile& file) {
  file.metadata[kPressure] = solution.pressure_kpa;
  std::vector<double>& plates = file.metadata[kPlates];
  plates.clear();
  for (const auto number : kPlateNumbers) plates.push_back(solution.*number);
}

std::optional<SolutionRecord> read_solution(const MeshFile& file, const std::string& name) {
  const auto pressure = file.metadata.find(kPressure);
  const std::vector<double>* plates =
      find_field(file.metadata, name, kPlates, kPlateNumbers.size());
  if (pressure == file.metadata.end() || !plates) return std::nullopt;
  SolutionRecord solution;
  solution.pressure_kpa = pressure->second;
  for (std::size_t i = 0; i < plates->size(); ++i) solution.*kPlateNumbers[i] = (*plates)[i];
  return solution;
}

void erase_solution(MeshFile& file) {
  file.metadata.erase(kPressure);
  file.metadata.erase(kPlates);
}

}  // namespace mammotwin
