#include "pipeline/steps/registered_record.h"

#include <stdexcept>

#include "fitting/mesh/metadata_field.h"

namespace mammotwin {
namespace {

constexpr const char* kBaseline = "baseline";
constexpr const char* kSd = "state_sd";
constexpr const char* kCovariance = "state_covariance";
constexpr const char* kDiscrepancy = "discrepancy_mm";
constexpr const char* kEdge = "plates_edge";  // its turn [deg], and shift in depth and lateral [mm]
constexpr const char* kEnd = "search_end";
constexpr const char* kVaried = "varied_";
constexpr const char *kUp = "what_if_up_", *kDown = "what_if_down_";

// The field `baseline`, number by number.
enum BaselineNumber {
  kOrigin,              // of the view's frame in LPS [mm]
  kAxes = kOrigin + 3,  // its depth, lateral and height in LPS
  kThickness_mm = kAxes + 9,
  kTurn_deg,
  kShiftU_mm,
  kShiftV_mm,
  kBaselineNumbers
};

std::vector<double> numbers_of(const RegisteredRecord::Baseline& baseline) {
  std::vector<double> n(kBaselineNumbers);
  Eigen::Vector3d::Map(&n[kOrigin]) = baseline.frame.origin_in_lps;
  Eigen::Matrix<double, 3, 3, Eigen::RowMajor>::Map(&n[kAxes]) = baseline.frame.axes;
  n[kThickness_mm] = baseline.thickness_mm;
  n[kTurn_deg] = baseline.turn_deg;
  n[kShiftU_mm] = baseline.shift_mm.x();
  n[kShiftV_mm] = baseline.shift_mm.y();
  return n;
}

RegisteredRecord::Baseline baseline_from(const std::vector<double>& n) {
  RegisteredRecord::Baseline baseline;
  baseline.frame.origin_in_lps = Eigen::Vector3d::Map(&n[kOrigin]);
  baseline.frame.axes = Eigen::Matrix<double, 3, 3, Eigen::RowMajor>::Map(&n[kAxes]);
  baseline.thickness_mm = n[kThickness_mm];
  baseline.turn_deg = n[kTurn_deg];
  baseline.shift_mm = {n[kShiftU_mm], n[kShiftV_mm]};
  return baseline;
}

Nodes configuration(const MeshFile& file, const std::string& name) {
  const auto found = file.configurations.find(name);
  return found == file.configurations.end() ? Nodes{} : found->second;
}

std::optional<ViewUncertainty> read_uncertainty(const MeshFile& file, const std::string& name) {
  const std::vector<double>* sd = find_field(file.metadata, name, kSd, kStates);
  const std::vector<double>* covariance =
      find_field(file.metadata, name, kCovariance, kStates * kStates);
  const std::vector<double>* discrepancy = find_field(file.metadata, name, kDiscrepancy, 1);
  const std::vector<double>* edge = find_field(file.metadata, name, kEdge, 3);
  if (!sd || !covariance || !discrepancy || !edge) return std::nullopt;
  ViewUncertainty uncertainty;
  uncertainty.sd = ViewState::Map(sd->data());
  uncertainty.covariance = Eigen::Matrix<double, kStates, kStates>::Map(covariance->data());
  uncertainty.discrepancy_mm = discrepancy->front();
  uncertainty.edge = {edge->at(0), {edge->at(1), edge->at(2)}};
  for (int i = 0; i < kMechanical; ++i)
    uncertainty.varied[i] = configuration(file, std::string(kVaried) + kStateNames[i]);
  return uncertainty;
}

WhatIfShapes read_what_if(const MeshFile& file) {
  WhatIfShapes shapes;
  for (std::size_t n = 0; n < shapes.size(); ++n) {
    const char* name = kStateNames[kWhatIf[n].number];
    WhatIfEnds ends{configuration(file, std::string(kUp) + name),
                    configuration(file, std::string(kDown) + name)};
    if (!ends.up.empty() && !ends.down.empty()) shapes[n] = std::move(ends);
  }
  return shapes;
}

void write_what_if(const WhatIfShapes& shapes, MeshFile& file) {
  for (std::size_t n = 0; n < shapes.size(); ++n) {
    if (shapes[n].up.empty()) continue;
    const char* name = kStateNames[kWhatIf[n].number];
    file.configurations[std::string(kUp) + name] = shapes[n].up;
    file.configurations[std::string(kDown) + name] = shapes[n].down;
  }
}

SearchEnd read_end(const MeshFile& file, const std::string& name) {
  const std::vector<double>* number = find_field(file.metadata, name, kEnd, 1);
  if (!number) return SearchEnd::none;
  for (const SearchEnd end :
       {SearchEnd::none, SearchEnd::ok, SearchEnd::look, SearchEnd::no_registration})
    if (number->front() == static_cast<double>(end)) return end;
  throw std::runtime_error(name + ": the field " + kEnd + " is " + std::to_string(number->front()) +
                           "; expected 0 to 3");
}

void write_uncertainty(const ViewUncertainty& uncertainty, MeshFile& file) {
  file.metadata[kSd] = {uncertainty.sd.begin(), uncertainty.sd.end()};
  const auto& c = uncertainty.covariance;
  file.metadata[kCovariance] = {c.data(), c.data() + c.size()};
  file.metadata[kDiscrepancy] = {uncertainty.discrepancy_mm};
  const PlatesEdge& edge = uncertainty.edge;
  file.metadata[kEdge] = {edge.turn_deg, edge.shift_mm.x(), edge.shift_mm.y()};
  for (int i = 0; i < kMechanical; ++i)
    if (!uncertainty.varied[i].empty())
      file.configurations[std::string(kVaried) + kStateNames[i]] = uncertainty.varied[i];
}

}  // namespace

RegisteredRecord::Baseline record_of(const AffineBaseline& baseline) {
  return {baseline.frame(), baseline.thickness_mm(), baseline.turn_deg(), baseline.shift_mm()};
}

AffineBaseline baseline_of(const RegisteredRecord::Baseline& record, const HermiteMesh& prone,
                           CompressedView view) {
  view.frame = record.frame;
  view.thickness_mm = record.thickness_mm;
  AffineBaseline baseline(prone, view);
  baseline.place(record.turn_deg, record.shift_mm);
  return baseline;
}

void write_registered(const RegisteredRecord& record, MeshFile& file) {
  if (record.uncertainty) write_uncertainty(*record.uncertainty, file);
  write_what_if(record.what_if, file);
  if (record.baseline) file.metadata[kBaseline] = numbers_of(*record.baseline);
  file.metadata[kEnd] = {static_cast<double>(record.end)};
}

RegisteredRecord read_registered(const MeshFile& file, const std::string& name) {
  RegisteredRecord record;
  if (const auto* n = find_field(file.metadata, name, kBaseline, kBaselineNumbers))
    record.baseline = baseline_from(*n);
  record.uncertainty = read_uncertainty(file, name);
  record.what_if = read_what_if(file);
  record.end = read_end(file, name);
  if (record.uncertainty)
    record.uncertainty->against_mammogram =
        record.end == SearchEnd::ok || record.end == SearchEnd::look;
  return record;
}

bool is_of_registration(const std::string& configuration) {
  for (const char* begin : {kVaried, kUp, kDown})
    if (configuration.starts_with(begin)) return true;
  return false;
}

}  // namespace mammotwin
