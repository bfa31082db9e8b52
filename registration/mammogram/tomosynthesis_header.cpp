#include "registration/mammogram/tomosynthesis_header.h"

#include <dcmtk/dcmfg/fgframeanatomy.h>
#include <dcmtk/dcmfg/fginterface.h>
#include <dcmtk/dcmfg/fgpixmsr.h>
#include <dcmtk/dcmfg/fgplanor.h>
#include <dcmtk/dcmfg/fgplanpo.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace mammotwin {
namespace {

/// The functional group of a frame, shared or its own; null where there is none.
template <class Group>
Group* group_of(FGInterface& groups, int frame, DcmFGTypes::E_FGType type) {
  return OFstatic_cast(Group*, groups.get(static_cast<Uint32>(frame), type));
}

std::optional<Eigen::Vector3d> place_of(FGInterface& groups, int frame) {
  auto* plane = group_of<FGPlanePosPatient>(groups, frame, DcmFGTypes::EFG_PLANEPOSPATIENT);
  Eigen::Vector3d x;
  if (!plane || plane->getImagePositionPatient(x.x(), x.y(), x.z()).bad()) return std::nullopt;
  return x;
}

/// Letters of PatientOrientation for a direction in LPS, the longest component first.
std::string letters_of(const Eigen::Vector3d& way) {
  constexpr double kLeast = 0.3;  // 17 degrees off a plane
  constexpr const char* kLetters[3][2] = {{"R", "L"}, {"A", "P"}, {"F", "H"}};
  std::vector<int> axes{0, 1, 2};
  std::sort(axes.begin(), axes.end(),
            [&](int a, int b) { return std::abs(way[a]) > std::abs(way[b]); });
  std::string letters;
  for (const int axis : axes)
    if (std::abs(way[axis]) >= kLeast) letters += kLetters[axis][way[axis] > 0];
  return letters;
}

void read_orientation(FGInterface& groups, MammogramHeader& header) {
  auto* plane = group_of<FGPlaneOrientationPatient>(groups, 0, DcmFGTypes::EFG_PLANEORIENTPATIENT);
  Eigen::Vector3d row, column;
  if (!plane || plane
                    ->getImageOrientationPatient(row.x(), row.y(), row.z(), column.x(), column.y(),
                                                 column.z())
                    .bad())
    return;
  header.patient_orientation = {letters_of(row), letters_of(column)};
}

void read_laterality(FGInterface& groups, MammogramHeader& header) {
  auto* anatomy = group_of<FGFrameAnatomy>(groups, 0, DcmFGTypes::EFG_FRAMEANATOMY);
  FGFrameAnatomy::LATERALITY side;
  if (!anatomy || anatomy->getLaterality(side).bad()) return;
  if (side == FGFrameAnatomy::LATERALITY_L) header.image_laterality = std::string(1, 'L');
  if (side == FGFrameAnatomy::LATERALITY_R) header.image_laterality = std::string(1, 'R');
}

void read_spacings(FGInterface& groups, MammogramHeader& header) {
  auto* measures = group_of<FGPixelMeasures>(groups, 0, DcmFGTypes::EFG_PIXELMEASURES);
  if (!measures) return;
  double value = 0;
  if (header.pixel_spacing_mm.empty())
    for (unsigned long n = 0; measures->getPixelSpacing(value, n).good() && n < 2; ++n)
      header.pixel_spacing_mm.push_back(value);
  if (measures->getSpacingBetweenSlices(value).good()) header.slices->spacing_mm = value;
  if (measures->getSliceThickness(value).good()) header.slices->thickness_mm = value;
}

/// The middle of the angles that the tube went through.
std::optional<double> middle_angle(DcmItem& acquisition) {
  std::vector<double> angles;
  DcmItem* projection = nullptr;
  for (long n = 0;
       acquisition.findAndGetSequenceItem(DCM_PerProjectionAcquisitionSequence, projection, n)
           .good();
       ++n)
    if (const auto angle = number_of(*projection, DCM_PositionerPrimaryAngle))
      angles.push_back(*angle);
  if (!angles.empty()) return std::accumulate(angles.begin(), angles.end(), 0.) / angles.size();
  const auto start = number_of(acquisition, DCM_PrimaryPositionerScanStartAngle);
  const auto arc = number_of(acquisition, DCM_PrimaryPositionerScanArc);
  if (start && arc) return *start + *arc / 2;
  return std::nullopt;
}

void read_acquisition(DcmDataset& dataset, MammogramHeader& h) {
  DcmItem* item = nullptr;
  if (dataset.findAndGetSequenceItem(DCM_XRay3DAcquisitionSequence, item).bad()) return;
  const auto fill = [&](std::optional<double>& value, const DcmTagKey& tag) {
    if (!value) value = number_of(*item, tag);
  };
  fill(h.thickness_mm, DCM_BodyPartThickness);
  fill(h.force, DCM_CompressionForce);
  fill(h.source_to_detector_mm, DCM_DistanceSourceToDetector);
  fill(h.source_to_patient_mm, DCM_DistanceSourceToPatient);
  fill(h.magnification, DCM_EstimatedRadiographicMagnificationFactor);
  fill(h.primary_angle_deg, DCM_PositionerPrimaryAngle);
  if (!h.primary_angle_deg) h.primary_angle_deg = middle_angle(*item);
  if (h.paddle.empty()) h.paddle = text_of(*item, DCM_PaddleDescription);
}

}  // namespace

void read_tomosynthesis(DcmDataset& dataset, const std::string& file, MammogramHeader& header) {
  header.slices = SliceTags{};
  FGInterface groups;
  if (groups.read(dataset).bad() || groups.getNumberOfFrames() == 0)
    throw std::runtime_error(file +
                             ": (5200,9229) and (5200,9230) functional groups cannot be read; "
                             "expected those of a Breast Tomosynthesis Image (have it sent again)");
  const int last = static_cast<int>(groups.getNumberOfFrames()) - 1;
  header.slices->first_in_lps = place_of(groups, 0);
  header.slices->last_in_lps = place_of(groups, last);
  if (header.patient_orientation.empty()) read_orientation(groups, header);
  if (header.image_laterality.empty()) read_laterality(groups, header);
  read_spacings(groups, header);
  read_acquisition(dataset, header);
}

}  // namespace mammotwin
