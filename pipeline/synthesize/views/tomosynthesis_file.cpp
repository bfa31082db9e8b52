#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmfg/fgframeanatomy.h>
#include <dcmtk/dcmfg/fginterface.h>
#include <dcmtk/dcmfg/fgpixmsr.h>
#include <dcmtk/dcmfg/fgplanor.h>
#include <dcmtk/dcmfg/fgplanpo.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <stdexcept>

#include "pipeline/synthesize/views/dicom_codes.h"
#include "pipeline/synthesize/views/true_tomosynthesis.h"

namespace mammotwin {
namespace {

constexpr int kBits = 12;
constexpr double kMostAttenuation = 6;  // -ln(I/I0) that is shown white

/// As decimal strings are written: at most 16 characters.
std::string text_of(double value) {
  char text[24];
  std::snprintf(text, sizeof text, "%.9g", std::abs(value) < 1e-9 ? 0. : value);
  return text;
}

/// The image as it hangs: chest wall left for a left breast, lateral or head up.
struct Hanging {
  Eigen::Vector3d row, column;  ///< directions of increasing column and row, in LPS
  bool wall_left;
};
Hanging hanging(const CompressedView& view) {
  const bool left = view.side == Side::left;
  const Eigen::Vector3d depth = view.frame.axes.row(0), lateral = view.frame.axes.row(1);
  return {left ? depth : Eigen::Vector3d(-depth), -lateral, left};
}

/// LPS position of the first pixel of a slice.
Eigen::Vector3d first_pixel(const TomosynthesisVolume& volume, const CompressedView& view,
                            int slice) {
  const DetectorImage& image = volume.slices.front();
  const double last_u = image.first.x() + (image.columns - 1) * image.spacing_mm;
  const double last_v = image.first.y() + (image.rows - 1) * image.spacing_mm;
  return view.frame.lps_from_view(
      {hanging(view).wall_left ? image.first.x() : last_u, last_v, volume.stack.height_of(slice)});
}

/// The view as the machine knows it: the plates at the header's angle, the breast square to them.
CompressedView said_view(CompressedView view, double angle_deg) {
  view.frame.axes = view_axes(view.side, angle_deg);
  return view;
}

void write_groups(const TomosynthesisVolume& volume, const CompressedView& view, DcmDataset& d) {
  FGInterface groups;
  groups.setCheckOnWrite(OFFalse);
  FGPixelMeasures measures;
  measures.setPixelSpacing((text_of(volume.pixel_mm) + "\\" + text_of(volume.pixel_mm)).c_str());
  measures.setSliceThickness(text_of(volume.stack.spacing_mm).c_str());
  measures.setSpacingBetweenSlices(text_of(volume.stack.spacing_mm).c_str());
  groups.addShared(measures);
  const Hanging h = hanging(view);
  FGPlaneOrientationPatient orientation;
  orientation.setImageOrientationPatient(
      text_of(h.row.x()).c_str(), text_of(h.row.y()).c_str(), text_of(h.row.z()).c_str(),
      text_of(h.column.x()).c_str(), text_of(h.column.y()).c_str(), text_of(h.column.z()).c_str());
  groups.addShared(orientation);
  FGFrameAnatomy anatomy;
  anatomy.setLaterality(view.side == Side::left ? FGFrameAnatomy::LATERALITY_L
                                                : FGFrameAnatomy::LATERALITY_R);
  anatomy.getAnatomy().getAnatomicRegion().set("76752008", "SCT", "Breast");
  groups.addShared(anatomy);
  for (int n = 0; n < volume.stack.count; ++n) {
    const Eigen::Vector3d x = first_pixel(volume, view, n + 1);
    FGPlanePosPatient place;
    place.setImagePositionPatient(text_of(x.x()).c_str(), text_of(x.y()).c_str(),
                                  text_of(x.z()).c_str());
    groups.addPerFrame(static_cast<Uint32>(n), place);
  }
  if (groups.write(d).bad()) throw std::runtime_error("functional groups cannot be written");
}

void write_acquisition(double angle_deg, double thickness_mm, DcmDataset& d) {
  constexpr double kArc_deg = 15;
  DcmItem* item = nullptr;
  d.findOrCreateSequenceItem(DCM_XRay3DAcquisitionSequence, item, -2);
  item->putAndInsertString(DCM_BodyPartThickness, text_of(thickness_mm).c_str());
  item->putAndInsertString(DCM_DistanceSourceToDetector, "660");
  item->putAndInsertString(DCM_DistanceSourceToPatient, "660");
  item->putAndInsertFloat64(DCM_PrimaryPositionerScanArc, kArc_deg);
  item->putAndInsertFloat64(DCM_PrimaryPositionerScanStartAngle, angle_deg - kArc_deg / 2);
}

std::vector<Uint16> pixels_of(const TomosynthesisVolume& volume, bool wall_left) {
  const double most = std::pow(2, kBits) - 1;
  std::vector<Uint16> pixels;
  for (const DetectorImage& slice : volume.slices)
    for (int row = 0; row < slice.rows; ++row)
      for (int column = 0; column < slice.columns; ++column) {
        const int i = wall_left ? column : slice.columns - 1 - column;
        const double share = slice.at(i, slice.rows - 1 - row) / kMostAttenuation;
        pixels.push_back(static_cast<Uint16>(std::lround(most * std::clamp(share, 0., 1.))));
      }
  return pixels;
}

void write_pixels(const TomosynthesisVolume& volume, bool wall_left, DcmDataset& d) {
  const DetectorImage& image = volume.slices.front();
  d.putAndInsertString(DCM_NumberOfFrames, std::to_string(volume.stack.count).c_str());
  d.putAndInsertUint16(DCM_Rows, static_cast<Uint16>(image.rows));
  d.putAndInsertUint16(DCM_Columns, static_cast<Uint16>(image.columns));
  d.putAndInsertUint16(DCM_SamplesPerPixel, 1);
  d.putAndInsertUint16(DCM_BitsAllocated, 16);
  d.putAndInsertUint16(DCM_BitsStored, kBits);
  d.putAndInsertUint16(DCM_HighBit, kBits - 1);
  d.putAndInsertUint16(DCM_PixelRepresentation, 0);
  d.putAndInsertString(DCM_PhotometricInterpretation, "MONOCHROME2");
  const std::vector<Uint16> pixels = pixels_of(volume, wall_left);
  d.putAndInsertUint16Array(DCM_PixelData, pixels.data(), pixels.size());
}

}  // namespace

void write_tomosynthesis(const std::filesystem::path& path, const TomosynthesisVolume& volume,
                         const CompressedView& view, double angle_deg, double thickness_mm) {
  DcmFileFormat file;
  DcmDataset& d = *file.getDataset();
  d.putAndInsertString(DCM_SOPClassUID, UID_BreastTomosynthesisImageStorage);
  d.putAndInsertString(DCM_SOPInstanceUID, view.name == "cc" ? "1.2.3.4.1" : "1.2.3.4.2");
  d.putAndInsertString(DCM_Modality, "MG");
  d.putAndInsertString(DCM_ImageType, "DERIVED\\PRIMARY\\TOMOSYNTHESIS\\NONE");
  d.putAndInsertString(DCM_PresentationIntentType, "FOR PRESENTATION");
  d.putAndInsertString(DCM_PositionerType, "MAMMOGRAPHIC");
  d.putAndInsertString(DCM_BreastImplantPresent, "NO");
  put_view_code(d, view.name);
  write_acquisition(angle_deg, thickness_mm, d);
  write_groups(volume, said_view(view, angle_deg), d);
  write_pixels(volume, hanging(view).wall_left, d);
  if (file.saveFile(path.c_str(), EXS_LittleEndianExplicit).bad())
    throw std::runtime_error(path.string() + ": cannot be written");
}

}  // namespace mammotwin
