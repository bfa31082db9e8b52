#include "pipeline/steps/registered_record.h"

#include <stdexcept>

#include "fitting/mesh/metadata_field.h"

namespace mammotwin {
namespace {

constexpr const char* kBaseline = "baseline";
constexpr const char* kSd = "state_sd";
constexpr const char* kCovariance = "state_covariance";
constexpr const char* kDiscrepancy = "discrepancy_mm";
constexpr const char* kEnd = "search_end";
constexpr const char* kVaried = "varied_";

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

std::optional<ViewUncertainty> read_uncertainty(const MeshFile& file, const std::string& name) {
  const std::vector<double>* sd = find_field(file.metadata, name, kSd, kStates);
  const std::vector<double>* covariance =
      find_field(file.metadata, name, kCovariance, kStates * kStates);
  const std::vector<double>* discrepancy = find_field(file.metadata, name, kDiscrepancy, 1);
  if (!sd || !covariance || !discrepancy) return std::nullopt;
  ViewUncertainty uncertainty;
  uncertainty.sd = ViewState::Map(sd->data());
  uncertainty.covariance = Eigen::Matrix<double, kStates, kStates>::Map(covariance->data());
  uncertainty.discrepancy_mm = discrepancy->front();
  for (int i = 0; i < kMechanical; ++i)
    if (const auto varied = file.configurations.find(std::string(kVaried) + kStateNames[i]);
        varied != file.configurations.end())
      uncertainty.varied[i] = varied->second;
  return uncertainty;
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
  if (record.baseline) file.metadata[kBaseline] = numbers_of(*record.baseline);
  file.metadata[kEnd] = {static_cast<double>(record.end)};
}

RegisteredRecord read_registered(const MeshFile& file, const std::string& name) {
  RegisteredRecord record;
  if (const auto* n = find_field(file.metadata, name, kBaseline, kBaselineNumbers))
    record.baseline = baseline_from(*n);
  record.uncertainty = read_uncertainty(file, name);
  record.end = read_end(file, name);
  return record;
}

bool is_varied(const std::string& configuration) { return configuration.starts_with(kVaried); }

}  // namespace mammotwin
