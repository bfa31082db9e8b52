#include "registration/export/dicom_export.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "registration/mammogram/header_geometry.h"
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
  write_measurement_report(out("sr.dcm"), mammogram(), {mark_, second}, "mlo");
  const std::string text = said_by("dsrdump +Pl " + out("sr.dcm").string());
  EXPECT_NE(text.find("exit 0"), std::string::npos) << text;
  EXPECT_NE(text.find("Imaging Measurement Report"), std::string::npos) << text;
  EXPECT_NE(text.find("L2, prone MRI LPS 61.000 20.000 35.000 mm"), std::string::npos) << text;
  EXPECT_NE(text.find("\"1.500\""), std::string::npos) << text;
}

TEST_F(DicomExport, SimulatedViewIsAMammogramOfTheSameView) {
  GreyPixels pixels{3, 2, {0, 1, 2, 3, 4, 60000}};
  write_simulated_mammogram(out("mg_out.dcm"), mammogram(), pixels, 0.5, "A\\F", "mlo");
  const MammogramHeader header = read_mammogram_header(out("mg_out.dcm"));
  const HeaderGeometry geometry = header_geometry(header, "mlo", Side::left);
  EXPECT_EQ(geometry.detector.pixels->spacing_mm, 0.5);
  EXPECT_EQ(geometry.angle_deg, 48);
  const MammogramImage image = read_mammogram_dicom(out("mg_out.dcm"));
  EXPECT_EQ(image.columns, 3);
  EXPECT_EQ(image.at(2, 1), 60000);
}

TEST_F(DicomExport, IsEqualAgain) {
  for (const char* name : {"a.dcm", "b.dcm"})
    write_measurement_report(out(name), mammogram(), {mark_}, "mlo");
  EXPECT_EQ(bytes_of(out("a.dcm")), bytes_of(out("b.dcm")));
}

}  // namespace
}  // namespace mammotwin
