#include <dcmtk/config/osconfig.h>
#include <dcmtk/dcmdata/dcpixseq.h>
#include <dcmtk/dcmdata/dcpxitem.h>
#include <dcmtk/dcmdata/dcrleerg.h>
#include <dcmtk/dcmdata/dctk.h>
#include <dcmtk/dcmjpls/djencode.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <functional>
#include <vector>

#include "registration/mammogram/header_geometry.h"
#include "registration/mammogram/mammogram_pixels.h"
#include "tests/registration/mammogram_dicom.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

using Change = std::function<void(DcmDataset&)>;

class Header : public ::testing::Test {
 protected:
  Header() : path_(fs::temp_directory_path() / ("header_" + std::to_string(getpid()) + ".dcm")) {}
  ~Header() override { fs::remove(path_); }

  void write(const Change& change) const {
    DcmFileFormat file;
    fill_mammogram(*file.getDataset());
    change(*file.getDataset());
    ASSERT_TRUE(file.saveFile(path_.c_str(), EXS_LittleEndianExplicit).good());
  }
  HeaderGeometry read(const Change& change, const HeaderOverrides& overrides = {}) const {
    write(change);
    return header_geometry(read_mammogram_header(path_), "mlo", Side::left, overrides);
  }
  /// What is said: the refusal, or all remarks.
  std::string said(const Change& change, const HeaderOverrides& overrides = {}) const {
    try {
      std::string all = "read";
      for (const std::string& remark : read(change, overrides).remarks) all += "; " + remark;
      return all;
    } catch (const std::runtime_error& error) {
      return error.what();
    }
  }
  /// Pixels of one fragment that nobody decodes.
  void write_as_jpeg_2000() const {
    DcmFileFormat file;
    DcmDataset& d = *file.getDataset();
    fill_mammogram(d);
    auto* sequence = new DcmPixelSequence(DCM_PixelSequenceTag);
    sequence->insert(new DcmPixelItem(DCM_PixelItemTag));  // offset table
    auto* fragment = new DcmPixelItem(DCM_PixelItemTag);
    Uint8 bytes[] = {0xff, 0x4f, 0xff, 0x51};  // how a code stream begins
    fragment->putUint8Array(bytes, sizeof bytes);
    sequence->insert(fragment);
    auto* pixels = new DcmPixelData(DCM_PixelData);
    pixels->putOriginalRepresentation(EXS_JPEG2000LosslessOnly, nullptr, sequence);
    d.insert(pixels, true);
    ASSERT_TRUE(file.saveFile(path_.c_str(), EXS_JPEG2000LosslessOnly).good());
  }
  fs::path path_;
};

Change set(const DcmTagKey& tag, const char* value) {
  return [=](DcmDataset& d) { d.putAndInsertString(tag, value); };
}
Change without(const DcmTagKey& tag) {
  return [=](DcmDataset& d) { d.findAndDeleteElement(tag); };
}
Change coded(const char* code, const char* modifier = nullptr) {
  return [=](DcmDataset& d) {
    DcmItem* item = nullptr;
    d.findOrCreateSequenceItem(DCM_ViewCodeSequence, item, -2);
    item->putAndInsertString(DCM_CodeValue, code);
    item->putAndInsertString(DCM_CodeMeaning, "a view");
    if (!modifier) return;
    DcmItem* more = nullptr;
    item->findOrCreateSequenceItem(DCM_ViewModifierCodeSequence, more, -2);
    more->putAndInsertString(DCM_CodeMeaning, modifier);
  };
}
Change both(Change a, Change b) {
  return [=](DcmDataset& d) {
    a(d);
    b(d);
  };
}

TEST_F(Header, GivesTheGeometryOfAPlainView) {
  const HeaderGeometry g = read([](DcmDataset&) {});
  EXPECT_EQ(g.angle_deg, 48);
  EXPECT_EQ(g.thickness_mm, 57);
  EXPECT_EQ(g.force_N, 102);
  EXPECT_EQ(g.detector.source_distance_mm, 650);
  EXPECT_EQ(g.detector.support_gap_mm, 17);
  EXPECT_EQ(g.detector.pixels->spacing_mm, 0.1);
  EXPECT_EQ(g.detector.pixels->columns, 40);
  EXPECT_EQ(g.detector.pixels->rows, 60);
  EXPECT_EQ(g.detector.pixels->chest_wall, ImageEdge::left);
  EXPECT_TRUE(g.detector.pixels->lateral_at_top);
  EXPECT_TRUE(g.remarks.empty());
}

// Each line: what is wrong with the header, and the words that must be said of it. "read" begins
// what was accepted.
TEST_F(Header, NamesTheTagOfWhatIsMissingSwappedOrAbsurd) {
  const struct {
    Change change;
    const char* words;
  } table[] = {
      {set(DCM_Modality, "MR"), "(0008,0060) Modality is \"MR\"; expected MG"},
      {without(DCM_Modality), "(0008,0060) Modality is \"\""},
      {without(DCM_PresentationIntentType), "read; (0008,0068)"},
      {without(DCM_DistanceSourceToDetector),
       "read; (0018,1110) DistanceSourceToDetector is missing"},
      {set(DCM_DistanceSourceToDetector, "65"), "(0018,1110) DistanceSourceToDetector is 65"},
      {set(DCM_DistanceSourceToDetector, "0"), "(0018,1110) DistanceSourceToDetector is 0"},
      {set(DCM_DistanceSourceToPatient, "700"), "read; (0018,1111)"},
      {set(DCM_EstimatedRadiographicMagnificationFactor, "1.8"), "(0018,1114)"},
      {both(without(DCM_ImagerPixelSpacing), without(DCM_PixelSpacing)),
       "(0018,1164) ImagerPixelSpacing is missing"},
      {both(without(DCM_ImagerPixelSpacing), set(DCM_PixelSpacing, "0.095\\0.095")),
       "read; (0018,1164)"},
      {set(DCM_PixelSpacing, "0.09\\0.09"), "read; (0028,0030) PixelSpacing differs"},
      {set(DCM_ImagerPixelSpacing, "0.1\\0.2"),
       "(0018,1164) ImagerPixelSpacing is not one number twice"},
      {set(DCM_ImagerPixelSpacing, "0.1"),
       "(0018,1164) ImagerPixelSpacing is not one number twice"},
      {set(DCM_ImagerPixelSpacing, "10\\10"), "(0018,1164) ImagerPixelSpacing is 10"},
      {set(DCM_ImagerPixelSpacing, "0\\0"), "(0018,1164) ImagerPixelSpacing is 0"},
      {without(DCM_BodyPartThickness), "read; (0018,11A0) BodyPartThickness is missing"},
      {set(DCM_BodyPartThickness, "5.7"),
       "(0018,11A0) BodyPartThickness is 5.7; expected 15 to 130 mm (is it in cm?)"},
      {set(DCM_BodyPartThickness, "570"), "(0018,11A0) BodyPartThickness is 570"},
      {set(DCM_BodyPartThickness, "-57"), "(0018,11A0)"},
      {set(DCM_CompressionForce, "10.2"),
       "read; (0018,11A2) CompressionForce is 10.2; taken as dN"},
      {set(DCM_CompressionForce, "5000"), "read; (0018,11A2) CompressionForce is 5000"},
      {set(DCM_PaddleDescription, "SPOT COMPRESSION"), "(0018,11A4) PaddleDescription"},
      {set(DCM_PaddleDescription, "10CM MAG"), "(0018,11A4) PaddleDescription"},
      {set(DCM_PositionerType, "CARM"), "read; (0018,1508) PositionerType"},
      {without(DCM_PositionerPrimaryAngle),
       "read; (0018,1510) PositionerPrimaryAngle is missing; taken as 45"},
      {set(DCM_PositionerPrimaryAngle, "90"), "(0018,1510) PositionerPrimaryAngle is 90"},
      {set(DCM_PositionerPrimaryAngle, "0"), "(0018,1510) PositionerPrimaryAngle is 0"},
      {set(DCM_ViewPosition, "CC"),
       "(0018,5101) ViewPosition is CC; patient.toml gives this file as MLO"},
      {set(DCM_ViewPosition, "ML"), "(0018,5101) ViewPosition is ML"},
      {without(DCM_ViewPosition), "(0018,5101) ViewPosition is missing"},
      {coded("R-10242"),
       "(0018,5101) ViewPosition is MLO, but (0054,0220) ViewCodeSequence says CC"},
      {both(without(DCM_ViewPosition), coded("399162004")), "(0018,5101) ViewPosition is CC"},
      {coded("R-10226", "Magnification"), "(0054,0222)"},
      {coded("R-10226", "Spot Compression"), "(0054,0222)"},
      {coded("R-10226", "Implant Displaced"), "(0054,0222)"},
      {without(DCM_PatientOrientation), "(0020,0020) PatientOrientation is missing"},
      {set(DCM_PatientOrientation, "F\\A"), "(0020,0020) PatientOrientation begins with \"F\""},
      {set(DCM_PatientOrientation, "A\\L"), "(0020,0020) PatientOrientation has no second value"},
      {set(DCM_PatientOrientation, "A"), "(0020,0020) PatientOrientation has no second value"},
      {set(DCM_ImageLaterality, "R"),
       "(0020,0062) ImageLaterality is R; the MRI's breast is the left one"},
      {set(DCM_ImageLaterality, "B"), "(0020,0062) ImageLaterality is \"B\""},
      {without(DCM_ImageLaterality), "(0020,0062) ImageLaterality is missing"},
      {set(DCM_Laterality, "R"),
       "(0020,0062) ImageLaterality is L, but (0020,0060) Laterality is R"},
      {set(DCM_NumberOfFrames, "50"), "(0028,0008) NumberOfFrames"},
      {set(DCM_BreastImplantPresent, "YES"), "(0028,1300)"},
      {set(DCM_PartialView, "YES"), "(0028,1350)"},
  };
  for (const auto& line : table)
    EXPECT_EQ(said(line.change).substr(0, std::string(line.words).size()), line.words);
}

// What is odd but clear gets the right answer without a word.
TEST_F(Header, ReadsWhatIsOddButClear) {
  EXPECT_EQ(said(set(DCM_ImageLaterality, "L ")), "read");
  EXPECT_EQ(said(both(without(DCM_ImageLaterality), set(DCM_Laterality, "L"))), "read");
  EXPECT_EQ(said(both(without(DCM_ViewPosition), coded("399368009"))), "read");
  EXPECT_EQ(read(set(DCM_PositionerPrimaryAngle, "-48")).angle_deg, 48);
  EXPECT_EQ(read(set(DCM_PositionerPrimaryAngle, "312")).angle_deg, 48);
  EXPECT_EQ(read(set(DCM_CompressionForce, "10.2")).force_N, 102);
  const PixelGrid turned = *read(set(DCM_PatientOrientation, "P\\H")).detector.pixels;
  EXPECT_EQ(turned.chest_wall, ImageEdge::right);
  EXPECT_FALSE(turned.lateral_at_top);
  EXPECT_EQ(read(set(DCM_PatientOrientation, "PLF\\FL")).detector.pixels->chest_wall,
            ImageEdge::right);
}

TEST_F(Header, IsOverriddenByThePatientsFile) {
  HeaderOverrides o;
  o.thickness_mm = 51;
  o.angle_deg = 44;
  o.source_distance_mm = 660;
  o.pixel_spacing_mm = 0.07;
  o.chest_wall = ImageEdge::right;
  o.lateral_at_top = true;
  const HeaderGeometry g = read(
      [](DcmDataset& d) {
        d.putAndInsertString(DCM_BodyPartThickness, "5");
        d.putAndInsertString(DCM_PositionerPrimaryAngle, "0");
        d.putAndInsertString(DCM_DistanceSourceToDetector, "0");
        d.findAndDeleteElement(DCM_ImagerPixelSpacing);
        d.findAndDeleteElement(DCM_PatientOrientation);
      },
      o);
  EXPECT_EQ(g.thickness_mm, 51);
  EXPECT_EQ(g.angle_deg, 44);
  EXPECT_EQ(g.detector.source_distance_mm, 660);
  EXPECT_EQ(g.detector.pixels->spacing_mm, 0.07);
  EXPECT_EQ(g.detector.pixels->chest_wall, ImageEdge::right);
}

TEST_F(Header, SizesOfPixelsAreThoseOnTheDetector) {
  const auto element = [](DcmDataset& d) {
    d.putAndInsertString(DCM_ImagerPixelSpacing, "0.0941\\0.0941");
    d.putAndInsertString(DCM_DetectorElementSpacing, "0.1\\0.1");
  };
  const HeaderGeometry g = read(element);
  EXPECT_EQ(g.detector.pixels->spacing_mm, 0.1);
  EXPECT_NE(said(element).find("DetectorElementSpacing"), std::string::npos);
  // Binned twice: two elements to a pixel.
  EXPECT_EQ(read(set(DCM_DetectorElementSpacing, "0.05\\0.05")).detector.pixels->spacing_mm, 0.1);
}

TEST_F(Header, DistanceToTheBreastsTopIsNotTheSupports) {
  // 650 - 575 = 75 mm: 57 of breast and 18 of support.
  const HeaderGeometry g = read(set(DCM_DistanceSourceToPatient, "575"));
  EXPECT_NEAR(g.detector.support_gap_mm, 18, 1e-9);
  EXPECT_NE(said(set(DCM_DistanceSourceToPatient, "575")).find("breast's top"), std::string::npos);
  EXPECT_NEAR(read(set(DCM_DistanceSourceToPatient, "630")).detector.support_gap_mm, 20, 1e-9);
}

TEST_F(Header, StandardImagingIsNoMagnificationAndOddKindsAreSaid) {
  EXPECT_NO_THROW(read(set(DCM_PaddleDescription, "STANDARD IMAGING 18X24")));
  EXPECT_THROW(read(set(DCM_PaddleDescription, "MAG 10CM")), std::runtime_error);
  const char* kinds[][2] = {{"DERIVED\\PRIMARY\\\\GENERATED_2D", "synthetic"},
                            {"DERIVED\\PRIMARY\\\\SUBTRACTION", "subtraction"},
                            {"ORIGINAL\\PRIMARY\\\\STEREO_PLUS", "stereo"}};
  for (const auto& [type, word] : kinds)
    EXPECT_NE(said(set(DCM_ImageType, type)).find(word), std::string::npos) << type;
  EXPECT_NE(said([](DcmDataset& d) {
              d.putAndInsertString(DCM_CollimatorLeftVerticalEdge, "0");
              d.putAndInsertString(DCM_CollimatorRightVerticalEdge, "25");
            }).find("collimation"),
            std::string::npos);
}

TEST_F(Header, CompressedAndColouredPixelsAreReadOrRefusedByName) {
  write([](DcmDataset&) {});
  const MammogramImage plain = read_mammogram_dicom(path_);
  DcmRLEEncoderRegistration::registerCodecs();
  DJLSEncoderRegistration::registerCodecs();
  for (const E_TransferSyntax syntax : {EXS_RLELossless, EXS_JPEGLSLossless}) {
    DcmFileFormat file;
    fill_mammogram(*file.getDataset());
    ASSERT_TRUE(file.getDataset()->chooseRepresentation(syntax, nullptr).good());
    ASSERT_TRUE(file.saveFile(path_.c_str(), syntax).good());
    EXPECT_EQ(read_mammogram_dicom(path_).grey, plain.grey) << syntax;
  }
  write_as_jpeg_2000();
  try {
    read_mammogram_dicom(path_);
    ADD_FAILURE() << "JPEG 2000 was read";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("JPEG 2000"), std::string::npos) << error.what();
  }
}

TEST_F(Header, ColourIsReadWhereItIsGrey) {
  const auto colour = [](Uint8 last) {
    return [last](DcmDataset& d) {
      d.putAndInsertUint16(DCM_SamplesPerPixel, 3);
      d.putAndInsertUint16(DCM_PlanarConfiguration, 0);
      d.putAndInsertUint16(DCM_BitsAllocated, 8);
      d.putAndInsertUint16(DCM_BitsStored, 8);
      d.putAndInsertUint16(DCM_HighBit, 7);
      d.putAndInsertString(DCM_PhotometricInterpretation, "RGB");
      std::vector<Uint8> pixels(3 * 40 * 60, 90);
      pixels.back() = last;
      d.putAndInsertUint8Array(DCM_PixelData, pixels.data(), pixels.size());
    };
  };
  write(colour(90));
  EXPECT_EQ(read_mammogram_dicom(path_).at(3, 5), 90);
  write(colour(91));
  EXPECT_THROW(read_mammogram_dicom(path_), std::runtime_error);
}

TEST_F(Header, PixelsAreBrightWhereTissueIsDense) {
  write([](DcmDataset&) {});
  EXPECT_TRUE(is_dicom(path_));
  const MammogramImage plain = read_mammogram_dicom(path_);
  EXPECT_EQ(plain.columns, 40);
  EXPECT_EQ(plain.rows, 60);
  EXPECT_GT(plain.at(0, 0), plain.at(1, 0));
  write(set(DCM_PhotometricInterpretation, "MONOCHROME1"));
  const MammogramImage inverted = read_mammogram_dicom(path_);
  EXPECT_LT(inverted.at(0, 0), inverted.at(1, 0));
}

TEST_F(Header, PaddingIsAir) {
  write([](DcmDataset& d) {
    std::vector<Uint16> pixels(40 * 60, 100);
    pixels[0] = 4000;
    pixels[1] = 3000;
    pixels[2] = 2900;
    d.putAndInsertUint16Array(DCM_PixelData, pixels.data(), pixels.size());
    d.putAndInsertUint16(DCM_PixelPaddingValue, 3000);
    d.putAndInsertUint16(DCM_PixelPaddingRangeLimit, 2800);
  });
  const MammogramImage image = read_mammogram_dicom(path_);
  EXPECT_EQ(image.at(0, 0), 4000);
  EXPECT_EQ(image.at(1, 0), 100);
  EXPECT_EQ(image.at(2, 0), 100);
}

}  // namespace
}  // namespace mammotwin
