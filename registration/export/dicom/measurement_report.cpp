#include <dcmtk/dcmsr/cmr/cid244e.h>
#include <dcmtk/dcmsr/cmr/tid1500.h>
#include <dcmtk/dcmsr/dsrdoc.h>

#include "registration/export/dicom/dicom_object.h"
#include "registration/export/dicom/image_points.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using namespace dicom;

using Group = CMR_TID1501_in_TID1500;

/// What a measurement was read off.
struct Outlined {
  DSRTypes::E_GraphicType type;
  std::vector<Float32> columns_rows;
};

DSRSpatialCoordinatesValue coordinates(const Outlined& outlined) {
  DSRSpatialCoordinatesValue value(outlined.type);
  for (std::size_t n = 0; n + 1 < outlined.columns_rows.size(); n += 2)
    value.getGraphicDataList().addItem(outlined.columns_rows[n], outlined.columns_rows[n + 1]);
  return value;
}

void measure(Group& group, const DSRCodedEntryValue& concept_name, double mm,
             const Outlined& outlined, const DSRImageReferenceValue& image) {
  const CMR_CID7181 millimetre(DSRCodedEntryValue("mm", "UCUM", "mm"));
  check(group.addMeasurement(CMR_CID7469(concept_name),
                             Group::MeasurementValue(number(mm).c_str(), millimetre)),
        "measurement");
  check(group.getMeasurement().addSpatialCoordinates(
            DSRCodedEntryValue("121112", "DCM", "Source of Measurement"), coordinates(outlined),
            image),
        "coordinates on the image");
}

void report_mark(const AnnotatedMark& mark, const Detector& detector, Side side,
                 const DSRImageReferenceValue& image, const std::string& uid, Group& group) {
  const Eigen::Vector3d& x = mark.prone_in_lps;
  const std::string where = in_ascii(mark.id) + ", prone MRI LPS " + number(x.x()) + " " +
                            number(x.y()) + " " + number(x.z()) + " mm";
  check(group.setTrackingIdentifier(where.c_str()), "tracking identifier");
  check(group.setTrackingUniqueIdentifier(uid.c_str()), "tracking UID");
  check(group.setFinding(DSRCodedEntryValue("4147007", "SCT", "Mass")), "finding");
  check(group.addFindingSite(
            DSRCodedEntryValue("76752008", "SCT", "Breast"),
            side == Side::left ? CID244e_Laterality::Left : CID244e_Laterality::Right),
        "finding site");
  const Outlined point{DSRTypes::GT_Point, on_image(detector, {mark.on_detector})};
  const Outlined ellipse{DSRTypes::GT_Ellipse, on_image(detector, ends_of(mark))};
  const struct {
    const char *code, *meaning;
    double mm;
    const Outlined& outlined;
  } values[] = {
      {"detector_u", "Depth on the detector from its chest-wall edge", mark.on_detector.x(), point},
      {"detector_v", "Lateral on the detector from its middle", mark.on_detector.y(), point},
      {"height", "Height above the support", mark.height_mm, point},
      {"ellipse_major", "Semi-major axis of the 90 % search ellipse", mark.ellipse.major_mm,
       ellipse},
      {"ellipse_minor", "Semi-minor axis of the 90 % search ellipse", mark.ellipse.minor_mm,
       ellipse}};
  for (const auto& value : values)
    measure(group, DSRCodedEntryValue(value.code, "99MAMMOTWIN", value.meaning), value.mm,
            value.outlined, image);
}

}  // namespace

void write_measurement_report(const fs::path& path, const fs::path& mammogram,
                              const Detector& detector, Side side,
                              const std::vector<AnnotatedMark>& marks, const std::string& key) {
  DcmFileFormat source_file = load(mammogram), file;
  DcmItem& source = *source_file.getDataset();
  CMR_TID1500 report(CMR_CID7021::ImagingMeasurementReport);
  check(report.setLanguage(DSRCodedEntryValue("en", "RFC5646", "English")), "language");
  check(report.addProcedureReported(DSRCodedEntryValue("71651007", "SCT", "Mammography")),
        "procedure");
  const std::string seed = text_of(source, DCM_SOPInstanceUID) + key;
  check(report.getObservationContext().addDeviceObserver(derived_uid("device").c_str(), kMaker),
        "observer");
  const DSRImageReferenceValue image(text_of(source, DCM_SOPClassUID).c_str(),
                                     text_of(source, DCM_SOPInstanceUID).c_str());
  for (std::size_t n = 0; n < marks.size(); ++n) {
    if (n > 0) check(report.addIndividualMeasurements(), "group");
    report_mark(marks[n], detector, side, image, derived_uid(seed + marks[n].id),
                report.getIndividualMeasurements());
  }
  DSRDocument document;
  check(document.setTreeFromRootTemplate(report, OFTrue), "tree");
  check(document.getCurrentRequestedProcedureEvidence().addItem(
            text_of(source, DCM_StudyInstanceUID).c_str(),
            text_of(source, DCM_SeriesInstanceUID).c_str(),
            text_of(source, DCM_SOPClassUID).c_str(), text_of(source, DCM_SOPInstanceUID).c_str()),
        "evidence");
  check(document.write(*file.getDataset()), "writing");
  const std::string sop_class = text_of(*file.getDataset(), DCM_SOPClassUID);
  const Moment made = moment_of_making();
  begin(source, sop_class.c_str(), "SR", key, made, *file.getDataset());
  put(*file.getDataset(), DCM_ContentDate, made.date);
  put(*file.getDataset(), DCM_ContentTime, made.time);
  put(*file.getDataset(), DCM_SeriesDescription, "Predicted places of MRI lesions, " + key);
  save(file, path);
}

}  // namespace mammotwin
