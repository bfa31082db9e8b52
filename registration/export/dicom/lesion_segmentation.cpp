#include <dcmtk/dcmfg/fgfracon.h>
#include <dcmtk/dcmfg/fgframeanatomy.h>
#include <dcmtk/dcmfg/fgpixmsr.h>
#include <dcmtk/dcmfg/fgplanor.h>
#include <dcmtk/dcmfg/fgplanpo.h>
#include <dcmtk/dcmseg/segdoc.h>
#include <dcmtk/dcmseg/segment.h>

#include <algorithm>
#include <memory>

#include "registration/export/dicom/dicom_export.h"
#include "registration/export/dicom/dicom_object.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using namespace dicom;

using Labels = Volume<std::uint8_t>;

/// A segmentation lies in a frame of reference (PS3.3 A.51); old MRI may name none, and gets one.
void name_frame_of_reference(DcmItem& source) {
  if (text_of(source, DCM_FrameOfReferenceUID).empty())
    put(source, DCM_FrameOfReferenceUID,
        derived_uid(text_of(source, DCM_SeriesInstanceUID) + "frame of reference"));
}

/// DCMTK takes the scanner's over: patient and study were asked for.
void leave_out_institution(DcmItem& object) {
  for (const DcmTagKey& tag : {DCM_InstitutionName, DCM_InstitutionAddress,
                               DCM_InstitutionalDepartmentName, DCM_StationName})
    object.findAndDeleteElement(tag);
}

std::unique_ptr<DcmSegmentation> empty_segmentation(const Labels& labels, DcmItem& source) {
  DcmSegmentation* made = nullptr;
  check(DcmSegmentation::createBinarySegmentation(
            made, static_cast<Uint16>(labels.size.y()), static_cast<Uint16>(labels.size.x()),
            IODGeneralEquipmentModule::EquipmentInfo(kMaker, kMaker, "0", "1"),
            ContentIdentificationMacro("1", "LESIONS", "Lesions seen in MRI", kMaker)),
        "segmentation");
  std::unique_ptr<DcmSegmentation> seg(made);
  check(seg->importHierarchy(source, OFTrue, OFTrue, OFTrue, OFFalse), "patient and study");
  check(seg->getSeries().setSeriesNumber("9000"), "series");
  return seg;
}

/// What all frames have: the grid lies along the patient's axes.
void add_geometry(const Labels& labels, Side side, DcmSegmentation& seg) {
  const std::unique_ptr<FGPlaneOrientationPatient> along(
      FGPlaneOrientationPatient::createMinimal("1", "0", "0", "0", "1", "0"));
  check(seg.addForAllFrames(*along), "orientation");
  FGPixelMeasures pixels;
  const Eigen::Vector3d& spacing = labels.spacing;
  check(pixels.setPixelSpacing((number(spacing.y()) + "\\" + number(spacing.x())).c_str()),
        "spacing");
  check(pixels.setSliceThickness(number(spacing.z()).c_str()), "slice thickness");
  check(pixels.setSpacingBetweenSlices(number(spacing.z()).c_str()), "slice spacing");
  check(seg.addForAllFrames(pixels), "pixel measures");
  FGFrameAnatomy anatomy;
  check(anatomy.setLaterality(side == Side::left ? FGFrameAnatomy::LATERALITY_L
                                                 : FGFrameAnatomy::LATERALITY_R),
        "laterality");
  check(anatomy.getAnatomy().getAnatomicRegion().set("76752008", "SCT", "Breast"), "anatomy");
  check(seg.addForAllFrames(anatomy), "anatomy");
}

void add_dimensions(DcmSegmentation& seg, const std::string& uid) {
  IODMultiframeDimensionModule& dimensions = seg.getDimensions();
  check(dimensions.addDimensionIndex(DCM_ReferencedSegmentNumber, uid.c_str(),
                                     DCM_SegmentIdentificationSequence, "Lesion"),
        "dimension");
  check(dimensions.addDimensionIndex(DCM_ImagePositionPatient, uid.c_str(),
                                     DCM_PlanePositionSequence, "Slice"),
        "dimension");
}

Uint16 add_segment(const Lesion& lesion, DcmSegmentation& seg) {
  DcmSegment* segment = nullptr;
  check(DcmSegment::create(
            segment, in_ascii(lesion.id).c_str(),
            CodeSequenceMacro("49755003", "SCT", "Morphologically Abnormal Structure"),
            CodeSequenceMacro("4147007", "SCT", "Mass"), DcmSegTypes::SAT_SEMIAUTOMATIC, kMaker),
        "segment");
  Uint16 segment_number = 0;
  check(seg.addSegment(segment, segment_number), "segment");
  return segment_number;
}

bool has_voxels(const Labels& labels, std::uint8_t value) {
  return std::find(labels.values.begin(), labels.values.end(), value) != labels.values.end();
}

/// A frame a slice that holds any of the lesion.
void add_frames(const Labels& labels, std::uint8_t value, Uint16 segment_number,
                DcmSegmentation& seg, std::vector<bool>& all) {
  for (int k = 0; k < labels.size.z(); ++k) {
    std::vector<Uint8> set;
    bool any = false;
    for (int j = 0; j < labels.size.y(); ++j)
      for (int i = 0; i < labels.size.x(); ++i) {
        set.push_back(labels(i, j, k) == value);
        any |= set.back() != 0;
      }
    if (!any) continue;
    const Eigen::Vector3d at = labels.position(0, 0, k);
    const std::unique_ptr<FGPlanePosPatient> place(FGPlanePosPatient::createMinimal(
        number(at.x()).c_str(), number(at.y()).c_str(), number(at.z()).c_str()));
    FGFrameContent content;
    check(content.setDimensionIndexValues(segment_number, 0), "frame");
    check(content.setDimensionIndexValues(static_cast<Uint32>(k + 1), 1), "frame");
    OFVector<FGBase*> own;
    own.push_back(place.get());
    own.push_back(&content);
    check(seg.addFrame(set.data(), segment_number, own), "frame");
    all.insert(all.end(), set.begin(), set.end());
  }
}

/// A bit a pixel, the first lowest, frames without a gap between them (PS3.5 8.1.1): DCMTK 3.6.7
/// loses pixels of frames that fill no whole bytes.
void put_pixels(const std::vector<bool>& set, DcmItem& object) {
  std::vector<Uint8> bytes((set.size() + 15) / 16 * 2, 0);
  for (std::size_t n = 0; n < set.size(); ++n)
    if (set[n]) bytes[n / 8] |= static_cast<Uint8>(1 << n % 8);
  check(object.putAndInsertUint8Array(DCM_PixelData, bytes.data(), bytes.size()), "pixels");
}

}  // namespace

bool has_lesion_voxels(const Segmentation& segmentation) {
  const auto& values = segmentation.labels.values;
  return std::any_of(values.begin(), values.end(), label::is_lesion);
}

void write_lesion_segmentation(const fs::path& path, const std::vector<fs::path>& slices,
                               const Segmentation& segmentation) {
  DcmFileFormat source_file = load_header(slices.at(0)), file;
  DcmItem &source = *source_file.getDataset(), &object = *file.getDataset();
  name_frame_of_reference(source);
  const Moment made = moment_of_making();
  const auto seg = empty_segmentation(segmentation.labels, source);
  add_geometry(segmentation.labels, segmentation.region.side, *seg);
  add_dimensions(*seg, derived_uid(text_of(source, DCM_SOPInstanceUID) + "dimensions"));
  std::vector<bool> set;
  for (std::size_t n = 0; n < segmentation.lesions.size(); ++n) {
    const auto value = static_cast<std::uint8_t>(label::lesion + n);
    if (!has_voxels(segmentation.labels, value)) continue;
    add_frames(segmentation.labels, value, add_segment(segmentation.lesions[n], *seg), *seg, set);
  }
  check(seg->writeDataset(object), "segmentation");
  leave_out_institution(object);
  begin(source, UID_SegmentationStorage, "SEG", "lesions", made, object);
  put(object, DCM_ContentDate, made.date);
  put(object, DCM_ContentTime, made.time);
  put(object, DCM_SeriesDescription, "Lesions seen in MRI");
  put_pixels(set, object);
  save(file, path);
}

}  // namespace mammotwin
