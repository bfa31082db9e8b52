#include "registration/export/dicom_export.h"

#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmsr/cmr/tid1500.h>
#include <dcmtk/dcmsr/dsrdoc.h>

#include <cctype>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <numbers>
#include <stdexcept>

#include "registration/export/burned_words.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

constexpr const char* kMaker = "Mammotwin";
/// What an object shares with the image that it speaks of.
const DcmTagKey kShared[] = {DCM_PatientName,      DCM_PatientID,
                             DCM_PatientBirthDate, DCM_PatientSex,
                             DCM_StudyInstanceUID, DCM_StudyDate,
                             DCM_StudyTime,        DCM_StudyID,
                             DCM_AccessionNumber,  DCM_ReferringPhysicianName};

DcmFileFormat load(const fs::path& path) {
  DcmFileFormat file;
  if (const OFCondition status = file.loadFile(path.c_str()); status.bad())
    throw std::runtime_error(path.filename().string() +
                             ": not readable as DICOM: " + status.text());
  return file;
}

std::string text_of(DcmItem& item, const DcmTagKey& tag, const char* otherwise = "") {
  OFString value;
  if (item.findAndGetOFStringArray(tag, value).bad() || value.empty()) return otherwise;
  return value.c_str();
}

/// FNV-1a, 64 bits.
std::uint64_t hashed(const std::string& text, std::uint64_t start) {
  for (const unsigned char c : text) start = (start ^ c) * 1099511628211ull;
  return start;
}

/// "2.25." and a number of 126 bits (PS3.5 B.2) that `text` gives.
std::string derived_uid(const std::string& text) {
  unsigned __int128 number = hashed(text, 14695981039346656037ull) >> 2;
  number = (number << 64) | hashed(text + "#", 1469598103934665603ull);
  std::string digits;
  for (; number > 0; number /= 10)
    digits.insert(digits.begin(), static_cast<char>('0' + static_cast<int>(number % 10)));
  return "2.25." + digits;
}

void put(DcmItem& item, const DcmTagKey& tag, const std::string& value) {
  if (const OFCondition status = item.putAndInsertString(tag, value.c_str()); status.bad())
    throw std::runtime_error("DICOM export: " + std::string(DcmTag(tag).getTagName()) + ": " +
                             status.text());
}

DcmItem& new_item(DcmItem& parent, const DcmTagKey& sequence) {
  DcmItem* item = nullptr;
  if (parent.findOrCreateSequenceItem(sequence, item, -2).bad() || !item)
    throw std::runtime_error("DICOM export: a sequence could not be made");
  return *item;
}

std::string upper(std::string text) {
  for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
  return text;
}

std::string number(double value) {
  char text[20];
  std::snprintf(text, sizeof text, "%.3f", value);
  return text;
}

/// Date and time of an object's making, as DICOM writes them: those of the clock, or of
/// SOURCE_DATE_EPOCH (reproducible-builds.org), then in UTC.
struct Moment {
  std::string date, time;
};

Moment moment_of_making() {
  const char* given = std::getenv("SOURCE_DATE_EPOCH");
  const std::time_t now = given ? std::strtoll(given, nullptr, 10) : std::time(nullptr);
  std::tm parts{};
  given ? gmtime_r(&now, &parts) : localtime_r(&now, &parts);
  char date[16], time[16];
  std::strftime(date, sizeof date, "%Y%m%d", &parts);
  std::strftime(time, sizeof time, "%H%M%S", &parts);
  return {date, time};
}

/// Patient, study, equipment and the object's own identity: another at each making, as an archive
/// keeps the first object of a name.
void begin(DcmItem& source, const char* sop_class, const char* modality, const std::string& key,
           const Moment& made, DcmItem& object) {
  for (const DcmTagKey& tag : kShared) put(object, tag, text_of(source, tag));
  if (source.tagExistsWithValue(DCM_SpecificCharacterSet))
    put(object, DCM_SpecificCharacterSet, text_of(source, DCM_SpecificCharacterSet));
  const std::string seed =
      text_of(source, DCM_SOPInstanceUID) + modality + key + made.date + made.time;
  put(object, DCM_InstanceCreationDate, made.date);
  put(object, DCM_InstanceCreationTime, made.time);
  put(object, DCM_SeriesDate, made.date);
  put(object, DCM_SeriesTime, made.time);
  put(object, DCM_SOPClassUID, sop_class);
  put(object, DCM_SOPInstanceUID, derived_uid(seed));
  put(object, DCM_SeriesInstanceUID, derived_uid(seed + "series"));
  put(object, DCM_SeriesNumber, "9000");
  put(object, DCM_InstanceNumber, "1");
  put(object, DCM_Modality, modality);
  put(object, DCM_Manufacturer, kMaker);
  put(object, DCM_ManufacturerModelName, kMaker);
  put(object, DCM_DeviceSerialNumber, "0");
  put(object, DCM_SoftwareVersions, "1");
}

void save(DcmFileFormat& file, const fs::path& path) {
  if (const OFCondition status = file.saveFile(path.c_str(), EXS_LittleEndianExplicit);
      status.bad())
    throw std::runtime_error(path.string() + ": cannot be written: " + status.text());
}

void refer(DcmItem& source, DcmItem& object) {
  DcmItem& series = new_item(object, DCM_ReferencedSeriesSequence);
  put(series, DCM_SeriesInstanceUID, text_of(source, DCM_SeriesInstanceUID));
  DcmItem& image = new_item(series, DCM_ReferencedImageSequence);
  put(image, DCM_ReferencedSOPClassUID, text_of(source, DCM_SOPClassUID));
  put(image, DCM_ReferencedSOPInstanceUID, text_of(source, DCM_SOPInstanceUID));
}

void refer_to_slice(DcmItem& source, int slice, DcmItem& annotation) {
  DcmItem& image = new_item(annotation, DCM_ReferencedImageSequence);
  put(image, DCM_ReferencedSOPClassUID, text_of(source, DCM_SOPClassUID));
  put(image, DCM_ReferencedSOPInstanceUID, text_of(source, DCM_SOPInstanceUID));
  put(image, DCM_ReferencedFrameNumber, std::to_string(slice));
}

/// DICOM's pixel coordinates begin with 1 at the first pixel's centre.
std::vector<Float32> on_image(const Detector& detector, const std::vector<Eigen::Vector2d>& uv) {
  std::vector<Float32> data;
  for (const Eigen::Vector2d& x : uv) {
    const Eigen::Vector2d pixel = detector.image_from_detector(x) + Eigen::Vector2d::Ones();
    data.insert(data.end(), {static_cast<Float32>(pixel.x()), static_cast<Float32>(pixel.y())});
  }
  return data;
}

/// Ends of the major, then of the minor axis, as the graphic type ELLIPSE has it.
std::vector<Eigen::Vector2d> ends_of(const AnnotatedMark& mark) {
  const double t = mark.ellipse.angle_deg * std::numbers::pi / 180;
  const Eigen::Vector2d along(std::cos(t), std::sin(t)), across(-std::sin(t), std::cos(t));
  return {mark.on_detector - mark.ellipse.major_mm * along,
          mark.on_detector + mark.ellipse.major_mm * along,
          mark.on_detector - mark.ellipse.minor_mm * across,
          mark.on_detector + mark.ellipse.minor_mm * across};
}

void annotate(const Detector& detector, const AnnotatedMark& mark, DcmItem& annotation) {
  DcmItem& graphic = new_item(annotation, DCM_GraphicObjectSequence);
  put(graphic, DCM_GraphicAnnotationUnits, "PIXEL");
  graphic.putAndInsertUint16(DCM_GraphicDimensions, 2);
  graphic.putAndInsertUint16(DCM_NumberOfGraphicPoints, 4);
  const std::vector<Float32> ends = on_image(detector, ends_of(mark));
  graphic.putAndInsertFloat32Array(DCM_GraphicData, ends.data(), ends.size());
  put(graphic, DCM_GraphicType, "ELLIPSE");
  put(graphic, DCM_GraphicFilled, "N");
  DcmItem& text = new_item(annotation, DCM_TextObjectSequence);
  put(text, DCM_AnchorPointAnnotationUnits, "PIXEL");
  put(text, DCM_UnformattedTextValue, mark.id + " (MRI), 90 %");
  const std::vector<Float32> anchor = on_image(detector, {mark.on_detector});
  text.putAndInsertFloat32Array(DCM_AnchorPoint, anchor.data(), anchor.size());
  put(text, DCM_AnchorPointVisibility, "N");
}

void show_whole(const PixelGrid& grid, DcmItem& object) {
  DcmItem& area = new_item(object, DCM_DisplayedAreaSelectionSequence);
  put(area, DCM_DisplayedAreaTopLeftHandCorner, "1\\1");
  put(area, DCM_DisplayedAreaBottomRightHandCorner,
      std::to_string(grid.columns) + "\\" + std::to_string(grid.rows));
  put(area, DCM_PresentationSizeMode, "SCALE TO FIT");
  put(area, DCM_PresentationPixelAspectRatio, "1\\1");
}

void check(const OFCondition& status, const char* what) {
  if (status.bad())
    throw std::runtime_error(std::string("DICOM report: ") + what + ": " + status.text());
}

using Group = CMR_TID1501_in_TID1500;

void measure(Group& group, const DSRCodedEntryValue& concept_name, double mm) {
  const CMR_CID7181 millimetre(DSRCodedEntryValue("mm", "UCUM", "mm"));
  check(group.addMeasurement(CMR_CID7469(concept_name),
                             Group::MeasurementValue(number(mm).c_str(), millimetre)),
        "measurement");
}

void report_mark(const AnnotatedMark& mark, const std::string& uid, Group& group) {
  const Eigen::Vector3d& x = mark.prone_in_lps;
  const std::string where = mark.id + ", prone MRI LPS " + number(x.x()) + " " + number(x.y()) +
                            " " + number(x.z()) + " mm";
  check(group.setTrackingIdentifier(where.c_str()), "tracking identifier");
  check(group.setTrackingUniqueIdentifier(uid.c_str()), "tracking UID");
  check(group.setFinding(DSRCodedEntryValue("4147007", "SCT", "Mass")), "finding");
  const struct {
    const char *code, *meaning;
    double mm;
  } values[] = {
      {"detector_u", "Depth on the detector from its chest-wall edge", mark.on_detector.x()},
      {"detector_v", "Lateral on the detector from its middle", mark.on_detector.y()},
      {"height", "Height above the support", mark.height_mm},
      {"ellipse_major", "Semi-major axis of the 90 % search ellipse", mark.ellipse.major_mm},
      {"ellipse_minor", "Semi-minor axis of the 90 % search ellipse", mark.ellipse.minor_mm}};
  for (const auto& value : values)
    measure(group, DSRCodedEntryValue(value.code, "99MAMMOTWIN", value.meaning), value.mm);
}

}  // namespace

void write_presentation_state(const fs::path& path, const fs::path& mammogram,
                              const Detector& detector, const std::vector<AnnotatedMark>& marks,
                              const std::string& key) {
  DcmFileFormat source_file = load(mammogram), file;
  DcmItem &source = *source_file.getDataset(), &object = *file.getDataset();
  const Moment made = moment_of_making();
  begin(source, UID_GrayscaleSoftcopyPresentationStateStorage, "PR", key, made, object);
  put(object, DCM_SeriesDescription, "Predicted places of MRI lesions, " + key);
  put(object, DCM_Laterality, text_of(source, DCM_ImageLaterality));
  put(object, DCM_ContentLabel, "MAMMOTWIN");
  put(object, DCM_ContentDescription, "Predicted places of lesions seen in MRI");
  put(object, DCM_PresentationCreationDate, made.date);
  put(object, DCM_PresentationCreationTime, made.time);
  put(object, DCM_ContentCreatorName, kMaker);
  refer(source, object);
  show_whole(*detector.pixels, object);
  for (const AnnotatedMark& mark : marks) {
    DcmItem& annotation = new_item(object, DCM_GraphicAnnotationSequence);
    put(annotation, DCM_GraphicLayer, "LESIONS");
    if (mark.slice) refer_to_slice(source, *mark.slice, annotation);
    annotate(detector, mark, annotation);
  }
  DcmItem& layer = new_item(object, DCM_GraphicLayerSequence);
  put(layer, DCM_GraphicLayer, "LESIONS");
  put(layer, DCM_GraphicLayerOrder, "1");
  put(object, DCM_PresentationLUTShape, "IDENTITY");
  save(file, path);
}

void write_measurement_report(const fs::path& path, const fs::path& mammogram,
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
  for (std::size_t n = 0; n < marks.size(); ++n) {
    if (n > 0) check(report.addIndividualMeasurements(), "group");
    report_mark(marks[n], derived_uid(seed + marks[n].id), report.getIndividualMeasurements());
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

void write_simulated_view(const fs::path& path, const fs::path& mammogram, const GreyPixels& bare,
                          double spacing_mm, const std::string& orientation,
                          const std::string& key) {
  const GreyPixels pixels = with_words(bare, "SIMULATED");
  DcmFileFormat source_file = load(mammogram), file;
  DcmItem &source = *source_file.getDataset(), &object = *file.getDataset();
  begin(source, UID_SecondaryCaptureImageStorage, "OT", key, moment_of_making(), object);
  put(object, DCM_SeriesDescription, "SIMULATED " + upper(key) + " from MRI, no exposure");
  put(object, DCM_BodyPartExamined, "BREAST");
  put(object, DCM_Laterality, text_of(source, DCM_ImageLaterality));
  put(object, DCM_ConversionType, "WSD");
  put(object, DCM_PatientOrientation, orientation);
  put(object, DCM_ImageType, "DERIVED\\SECONDARY");
  put(object, DCM_DerivationDescription, "Simulated from the compressed model of the breast's MRI");
  put(object, DCM_ImageComments, "Simulated, not an X-ray exposure");
  put(object, DCM_BurnedInAnnotation, "YES");
  const std::string spacing = number(spacing_mm) + "\\" + number(spacing_mm);
  put(object, DCM_PixelSpacing, spacing);
  object.putAndInsertUint16(DCM_Rows, static_cast<Uint16>(pixels.rows));
  object.putAndInsertUint16(DCM_Columns, static_cast<Uint16>(pixels.columns));
  object.putAndInsertUint16(DCM_SamplesPerPixel, 1);
  put(object, DCM_PhotometricInterpretation, "MONOCHROME2");
  object.putAndInsertUint16(DCM_BitsAllocated, 16);
  object.putAndInsertUint16(DCM_BitsStored, 16);
  object.putAndInsertUint16(DCM_HighBit, 15);
  object.putAndInsertUint16(DCM_PixelRepresentation, 0);
  object.putAndInsertUint16Array(DCM_PixelData, pixels.grey.data(), pixels.grey.size());
  save(file, path);
}

}  // namespace mammotwin
