#include "registration/export/dicom/dicom_export.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/registration/mammogram_dicom.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

/// What a program of DCMTK prints; its exit code comes last.
std::string said_by(const std::string& command) {
  std::string text;
  FILE* pipe = popen((command + " 2>&1; echo exit $?").c_str(), "r");
  std::array<char, 256> part;
  while (pipe && std::fgets(part.data(), part.size(), pipe)) text += part.data();
  if (pipe) pclose(pipe);
  return text;
}

std::string bytes_of(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

class DicomExport : public ::testing::Test {
 protected:
  DicomExport() : folder_(fs::path(testing::TempDir()) / ("dicom_" + std::to_string(getpid()))) {
    fs::create_directories(folder_);
    DcmFileFormat file;
    fill_mammogram(*file.getDataset());
    file.saveFile(mammogram().c_str(), EXS_LittleEndianExplicit);
    detector_.pixels = PixelGrid{0.1, 40, 60};
    mark_ = {"L1", {2, 0.5}, {1.5, 0.5, 0}, {61, 20, 35}, 30};
  }
  ~DicomExport() override { fs::remove_all(folder_); }
  fs::path mammogram() const { return folder_ / "mg.dcm"; }
  fs::path out(const char* name) const { return folder_ / name; }

  fs::path folder_;
  Detector detector_;
  AnnotatedMark mark_;
};

TEST_F(DicomExport, PresentationStateOfAVolumeDrawsOnTheLesionsSlice) {
  mark_.slice = 23;
  write_presentation_state(out("pr.dcm"), mammogram(), detector_, {mark_}, "mlo");
  DcmFileFormat file;
  ASSERT_TRUE(file.loadFile(out("pr.dcm").c_str()).good());
  DcmItem *annotation = nullptr, *image = nullptr;
  ASSERT_TRUE(
      file.getDataset()->findAndGetSequenceItem(DCM_GraphicAnnotationSequence, annotation).good());
  ASSERT_TRUE(annotation->findAndGetSequenceItem(DCM_ReferencedImageSequence, image).good());
  OFString frame;
  EXPECT_TRUE(image->findAndGetOFString(DCM_ReferencedFrameNumber, frame).good() && frame == "23");
}

TEST_F(DicomExport, PresentationStateDrawsTheEllipseOnItsImage) {
  write_presentation_state(out("pr.dcm"), mammogram(), detector_, {mark_}, "mlo");
  DcmFileFormat file;
  ASSERT_TRUE(file.loadFile(out("pr.dcm").c_str()).good());
  DcmItem& d = *file.getDataset();
  OFString text;
  EXPECT_TRUE(d.findAndGetOFString(DCM_StudyInstanceUID, text).good() && text == "1.2.3");
  EXPECT_TRUE(d.findAndGetOFString(DCM_PatientID, text).good() && text == "4711");
  DcmItem *series = nullptr, *image = nullptr, *annotation = nullptr, *graphic = nullptr;
  ASSERT_TRUE(d.findAndGetSequenceItem(DCM_ReferencedSeriesSequence, series).good());
  ASSERT_TRUE(series->findAndGetSequenceItem(DCM_ReferencedImageSequence, image).good());
  EXPECT_TRUE(image->findAndGetOFString(DCM_ReferencedSOPInstanceUID, text).good() &&
              text == "1.2.3.4");
  ASSERT_TRUE(d.findAndGetSequenceItem(DCM_GraphicAnnotationSequence, annotation).good());
  ASSERT_TRUE(annotation->findAndGetSequenceItem(DCM_GraphicObjectSequence, graphic).good());
  // (2, 0.5) mm at 0.1 mm: column 19.5, row 29.5 - 5 = 24.5 from 0; DICOM counts from 1. The major
  // axis of 1.5 mm lies along the columns' direction.
  const double expected[] = {20.5 - 15, 25.5, 20.5 + 15, 25.5};
  for (unsigned long n = 0; n < 4; ++n) {
    Float32 value = 0;
    ASSERT_TRUE(graphic->findAndGetFloat32(DCM_GraphicData, value, n).good());
    EXPECT_NEAR(value, expected[n], 1e-4);
  }
  const std::string checked = said_by("dcmpschk " + out("pr.dcm").string());
  EXPECT_NE(checked.find("exit 0"), std::string::npos) << checked;
  EXPECT_EQ(checked.find("Error"), std::string::npos) << checked;
}

TEST_F(DicomExport, ReportIsReadByDcmtk) {
  AnnotatedMark second = mark_;
  second.id = "L2";
  write_measurement_report(out("sr.dcm"), mammogram(), detector_, Side::left, {mark_, second},
                           "mlo");
  const std::string text = said_by("dsrdump +Pl " + out("sr.dcm").string());
  EXPECT_NE(text.find("exit 0"), std::string::npos) << text;
  EXPECT_NE(text.find("Imaging Measurement Report"), std::string::npos) << text;
  EXPECT_NE(text.find("L2, prone MRI LPS 61.000 20.000 35.000 mm"), std::string::npos) << text;
  EXPECT_NE(text.find("\"1.500\""), std::string::npos) << text;
  EXPECT_NE(text.find("(7771000,SCT,\"Left\")"), std::string::npos) << text;
  // Of (2, 0.5) mm and of the ellipse, as in the presentation state.
  EXPECT_NE(text.find("=(POINT,20.5/25.5"), std::string::npos) << text;
  EXPECT_NE(text.find("=(ELLIPSE,5.5/25.5,35.5/25.5"), std::string::npos) << text;
}

std::string text_in(const fs::path& path, const DcmTagKey& tag) {
  DcmFileFormat file;
  OFString text;
  if (file.loadFile(path.c_str()).bad()) return "unreadable";
  file.getDataset()->findAndGetOFStringArray(tag, text);
  return text.c_str();
}

/// 120 x 40 pixels of one grey.
GreyPixels plain_picture() { return {120, 40, std::vector<std::uint16_t>(120 * 40, 1000)}; }

// A letter's squares are 120 / (2 * 55) = 1 pixel: a band of 9 rows above the picture.
TEST_F(DicomExport, SimulatedViewSaysThatItIsOne) {
  write_simulated_view(out("sc.dcm"), mammogram(), plain_picture(), 0.5, "A\\F", "mlo");
  EXPECT_EQ(text_in(out("sc.dcm"), DCM_SOPClassUID), UID_SecondaryCaptureImageStorage);
  EXPECT_EQ(text_in(out("sc.dcm"), DCM_SeriesDescription), "SIMULATED MLO from MRI, no exposure");
  EXPECT_EQ(text_in(out("sc.dcm"), DCM_BurnedInAnnotation), "YES");
  EXPECT_EQ(text_in(out("sc.dcm"), DCM_StudyInstanceUID), "1.2.3");
  DcmFileFormat file;
  ASSERT_TRUE(file.loadFile(out("sc.dcm").c_str()).good());
  Uint16 rows = 0, pixel = 0;
  file.getDataset()->findAndGetUint16(DCM_Rows, rows);
  EXPECT_EQ(rows, 49);
  const auto at = [&](int column, int row) {
    file.getDataset()->findAndGetUint16(DCM_PixelData, pixel, row * 120 + column);
    return pixel;
  };
  EXPECT_EQ(at(1, 1), 0);      // the S begins with a gap
  EXPECT_EQ(at(2, 1), 65535);  // and goes on
  EXPECT_EQ(at(0, 9), 1000);   // the picture below the band is as it was
  EXPECT_EQ(at(119, 48), 1000);
  GreyPixels narrow{54, 1, std::vector<std::uint16_t>(54)};
  EXPECT_THROW(write_simulated_view(out("no.dcm"), mammogram(), narrow, 0.5, "A\\F", "mlo"),
               std::invalid_argument);
}

/// Two slices of an MRI, 4 x 3 pixels of 2 mm.
std::vector<fs::path> write_slices(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const char* name : {"1", "2"}) {
    DcmFileFormat file;
    DcmDataset& d = *file.getDataset();
    const std::string place = std::string("10\\-20\\3") + name;
    for (const auto& [tag, value] : std::initializer_list<std::pair<DcmTagKey, std::string>>{
             {DCM_SOPClassUID, UID_MRImageStorage},
             {DCM_SOPInstanceUID, std::string("1.2.9.1.") + name},
             {DCM_SeriesInstanceUID, "1.2.9.1"},
             {DCM_StudyInstanceUID, "1.2.9"},
             {DCM_FrameOfReferenceUID, "1.2.9.7"},
             {DCM_PatientName, "SECRET^NAME"},
             {DCM_PatientID, "4711"},
             {DCM_PatientBirthDate, "19700101"},
             {DCM_PatientSex, "F"},
             {DCM_StudyDate, "20200101"},
             {DCM_StudyTime, "090000"},
             {DCM_Modality, "MR"},
             {DCM_ImagePositionPatient, place}})
      d.putAndInsertString(tag, value.c_str());
    files.push_back(folder / (std::string(name) + ".mr.dcm"));
    EXPECT_TRUE(file.saveFile(files.back().c_str(), EXS_LittleEndianExplicit).good());
  }
  return files;
}

// Lesion L2 has one voxel, (1, 2) of the upper slice; L1 has none.
TEST_F(DicomExport, LesionsAreASegmentationOfTheMri) {
  Segmentation s;
  s.labels = Volume<std::uint8_t>({4, 3, 2}, {2, 2, 1}, {10, -20, 31});
  s.labels(1, 2, 1) = label::lesion + 1;
  s.lesions = {{"L1", {0, 0, 0}, 0}, {"L2", {0, 0, 0}, 0.004}};
  EXPECT_TRUE(has_lesion_voxels(s));
  write_lesion_segmentation(out("seg.dcm"), write_slices(folder_), s);
  const std::string said = said_by("dciodvfy " + out("seg.dcm").string());
  EXPECT_EQ(said.find("Error"), std::string::npos) << said;
  EXPECT_EQ(text_in(out("seg.dcm"), DCM_StudyInstanceUID), "1.2.9");
  EXPECT_EQ(text_in(out("seg.dcm"), DCM_FrameOfReferenceUID), "1.2.9.7");
  DcmFileFormat file;
  ASSERT_TRUE(file.loadFile(out("seg.dcm").c_str()).good());
  DcmItem& d = *file.getDataset();
  OFString text;
  EXPECT_TRUE(d.findAndGetOFString(DCM_NumberOfFrames, text).good() && text == "1");
  DcmItem *segment = nullptr, *frame = nullptr, *plane = nullptr;
  ASSERT_TRUE(d.findAndGetSequenceItem(DCM_SegmentSequence, segment).good());
  EXPECT_TRUE(segment->findAndGetOFString(DCM_SegmentLabel, text).good() && text == "L2");
  ASSERT_TRUE(d.findAndGetSequenceItem(DCM_PerFrameFunctionalGroupsSequence, frame).good());
  ASSERT_TRUE(frame->findAndGetSequenceItem(DCM_PlanePositionSequence, plane).good());
  plane->findAndGetOFStringArray(DCM_ImagePositionPatient, text);
  EXPECT_EQ(text, "10.000\\-20.000\\32.000");
  const Uint8* bits = nullptr;
  ASSERT_TRUE(d.findAndGetUint8Array(DCM_PixelData, bits).good());
  EXPECT_EQ(bits[0], 0);
  EXPECT_EQ(bits[1], 1 << (1 + 2 * 4 - 8));  // pixel 9 of 12, a bit each, the first lowest
}

// Text that means something to pages, tables, XML or DICOM; marks that DICOM's default characters
// do not have. Names with controls are refused before (patient_test, segmentation_file_test), and
// would not do harm here.
const std::vector<std::string> kHostileIds{"</script><b>&\"'", "=cmd|' /C calc'!A0", "a\\b\\c",
                                           "a\nb\x1b[31m\tc",  "\u202egnp.1L\u202c", "L\u00e4sion"};

TEST_F(DicomExport, HostileNamesOfLesionsStayOneValueOfPlainText) {
  for (const std::string& id : kHostileIds) {
    SCOPED_TRACE(id);
    mark_.id = id;
    write_presentation_state(out("pr.dcm"), mammogram(), detector_, {mark_}, "mlo");
    write_measurement_report(out("sr.dcm"), mammogram(), detector_, Side::left, {mark_}, "mlo");
    Segmentation s;
    s.labels = Volume<std::uint8_t>({4, 3, 2}, {2, 2, 1}, {10, -20, 31});
    s.labels(1, 2, 1) = label::lesion;
    s.lesions = {{id, {0, 0, 0}, 0.004}};
    write_lesion_segmentation(out("seg.dcm"), write_slices(folder_), s);
    for (const char* name : {"pr.dcm", "sr.dcm", "seg.dcm"}) {
      const std::string said = said_by("dciodvfy " + out(name).string());
      EXPECT_EQ(said.find("Error"), std::string::npos) << name << "\n" << said;
      const std::string bytes = bytes_of(out(name));
      for (const char* mark : {"\x1b[31m", "\xe2\x80\xae", "a\nb", "a\\b", "\xc3\xa4"})
        EXPECT_EQ(bytes.find(mark), std::string::npos) << name << " holds " << mark;
    }
    DcmFileFormat file;
    ASSERT_TRUE(file.loadFile(out("seg.dcm").c_str()).good());
    DcmItem* segment = nullptr;
    ASSERT_TRUE(file.getDataset()->findAndGetSequenceItem(DCM_SegmentSequence, segment).good());
    DcmElement* label = nullptr;
    ASSERT_TRUE(segment->findAndGetElement(DCM_SegmentLabel, label).good());
    EXPECT_EQ(label->getVM(), 1u);
  }
}

// dciodvfy (dicom3tools) knows what each kind of object must hold.
TEST_F(DicomExport, ObjectsAreWholeForAnArchive) {
  write_presentation_state(out("pr.dcm"), mammogram(), detector_, {mark_}, "mlo");
  write_measurement_report(out("sr.dcm"), mammogram(), detector_, Side::left, {mark_}, "mlo");
  write_simulated_view(out("sc.dcm"), mammogram(), plain_picture(), 0.5, "A\\F", "mlo");
  ASSERT_NE(said_by("dciodvfy " + mammogram().string()).find("Error"), std::string::npos)
      << "it finds what our plain mammogram lacks";
  for (const char* name : {"pr.dcm", "sr.dcm", "sc.dcm"}) {
    const std::string said = said_by("dciodvfy " + out(name).string());
    EXPECT_EQ(said.find("Error"), std::string::npos) << name << "\n" << said;
    EXPECT_NE(said.find("exit 0"), std::string::npos) << name << "\n" << said;
  }
}

// 1577934672 s after 1970 is 2020-01-02 03:11:12 UTC.
TEST_F(DicomExport, CarriesTheTimeOfItsOwnMaking) {
  setenv("SOURCE_DATE_EPOCH", "1577934672", 1);
  for (const char* name : {"a.dcm", "b.dcm"})
    write_measurement_report(out(name), mammogram(), detector_, Side::left, {mark_}, "mlo");
  setenv("SOURCE_DATE_EPOCH", "1577934673", 1);
  write_measurement_report(out("c.dcm"), mammogram(), detector_, Side::left, {mark_}, "mlo");
  unsetenv("SOURCE_DATE_EPOCH");
  EXPECT_EQ(text_in(out("a.dcm"), DCM_InstanceCreationDate), "20200102");
  EXPECT_EQ(text_in(out("a.dcm"), DCM_InstanceCreationTime), "031112");
  EXPECT_EQ(text_in(out("a.dcm"), DCM_StudyTime), "101112");  // the mammogram's
  EXPECT_EQ(bytes_of(out("a.dcm")), bytes_of(out("b.dcm")));
  EXPECT_NE(text_in(out("a.dcm"), DCM_SOPInstanceUID), text_in(out("c.dcm"), DCM_SOPInstanceUID));
}

}  // namespace
}  // namespace mammotwin
