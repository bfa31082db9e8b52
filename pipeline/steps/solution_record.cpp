#include "pipeline/steps/solution_record.h"

#include <array>
#include <stdexcept>

#include "fitting/mesh/metadata_field.h"

namespace mammotwin {
namespace {

constexpr const char* kPressure = "pressure_kpa";
constexpr const char* kPlates = "plates";
constexpr const char* kHolds = "friction_holds";
constexpr const char* kDrawnTimes = "drawn_times";

/// The field `plates`, number by number.
constexpr std::array kPlateNumbers = {&SolutionRecord::support_height_mm,
                                      &SolutionRecord::paddle_height_mm,
                                      &SolutionRecord::edge_mm,
                                      &SolutionRecord::lateral_middle_mm,
                                      &SolutionRecord::penalty_kpa_per_mm,
                                      &SolutionRecord::target_thickness_mm};

/// Of each: point, plate, anchor, pressure.
constexpr std::size_t kHoldNumbers = 6;

std::vector<double> numbers_of(const std::vector<PlateFriction::Hold>& holds) {
  std::vector<double> all;
  for (const PlateFriction::Hold& h : holds)
    all.insert(all.end(), {double(h.point), double(h.plate), h.anchor.x(), h.anchor.y(),
                           h.anchor.z(), h.pressure});
  return all;
}

std::vector<PlateFriction::Hold> holds_from(const std::vector<double>& n, const std::string& name) {
  if (n.size() % kHoldNumbers != 0)
    throw std::runtime_error(name + ": the field " + kHolds + " has " + std::to_string(n.size()) +
                             " numbers; expected " + std::to_string(kHoldNumbers) + " a point");
  std::vector<PlateFriction::Hold> holds;
  for (std::size_t i = 0; i < n.size(); i += kHoldNumbers)
    holds.push_back({static_cast<int>(n[i]),
                     static_cast<int>(n[i + 1]),
                     {n[i + 2], n[i + 3], n[i + 4]},
                     n[i + 5]});
  return holds;
}

}  // namespace

void write_solution(const SolutionRecord& solution, MeshFile& file) {
  file.metadata[kPressure] = solution.pressure_kpa;
  std::vector<double>& plates = file.metadata[kPlates];
  plates.clear();
  for (const auto number : kPlateNumbers) plates.push_back(solution.*number);
  file.metadata.erase(kHolds);
  file.metadata[kDrawnTimes] = {solution.drawn_times};
  if (!solution.holds.empty()) file.metadata[kHolds] = numbers_of(solution.holds);
}

std::optional<SolutionRecord> read_solution(const MeshFile& file, const std::string& name) {
  const auto pressure = file.metadata.find(kPressure);
  const std::vector<double>* plates =
      find_field(file.metadata, name, kPlates, kPlateNumbers.size());
  if (pressure == file.metadata.end() || !plates) return std::nullopt;
  SolutionRecord solution;
  solution.pressure_kpa = pressure->second;
  for (std::size_t i = 0; i < plates->size(); ++i) solution.*kPlateNumbers[i] = (*plates)[i];
  if (const auto* drawn = find_field(file.metadata, name, kDrawnTimes, 1))
    solution.drawn_times = drawn->front();
  if (const auto holds = file.metadata.find(kHolds); holds != file.metadata.end())
    solution.holds = holds_from(holds->second, name);
  return solution;
}

void erase_solution(MeshFile& file) {
  file.metadata.erase(kPressure);
  file.metadata.erase(kPlates);
  file.metadata.erase(kHolds);
  file.metadata.erase(kDrawnTimes);
}

}  // namespace mammotwin
