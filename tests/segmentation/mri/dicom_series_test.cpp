#include "segmentation/mri/read_mri.h"
#include "tests/segmentation/files/dicom_writer.h"
#include "tests/segmentation/message.h"

namespace mammotwin {
namespace {

/// A small stack; one value tells the series apart.
Volume<float> stack(float value, int slices = 20, double voxel_mm = 2) {
  Volume<float> image({8, 8, slices}, Eigen::Vector3d::Constant(voxel_mm), {0, 0, -20}, value);
  image(3, 3, 3) = 7;
  return image;
}

/// A dynamic study: localiser-like coarse series, three phases as series of their own in an order
/// of numbers that is not that of time, and a derived subtraction.
void write_study(const std::filesystem::path& folder) {
  DicomHeader h;
  const auto write = [&](const char* number, const char* time, const char* type, float value,
                         double voxel_mm) {
    h.series_number = number, h.series_uid = std::string("1.2.") + number;
    h.acquisition_time = time, h.image_type = type;
    write_dicom_series(folder, number, h, stack(value, 20, voxel_mm));
  };
  write("2", "110000", "ORIGINAL\\PRIMARY", 20, 4);
  write("9", "120000", "ORIGINAL\\PRIMARY", 90, 2);
  write("4", "120200", "ORIGINAL\\PRIMARY", 40, 2);
  write("5", "120400", "ORIGINAL\\PRIMARY", 50, 2);
  write("6", "120500", "DERIVED\\SECONDARY", 60, 2);
}

TEST(DicomSeries, OfADynamicStudyTheSecondInTimeIsReadAndSaid) {
  const EmptyFolder folder("study");
  write_study(folder.path);
  const Mri mri = read_mri(folder.path);
  EXPECT_EQ(mri.image(0, 0, 0), 40);
  ASSERT_FALSE(mri.notes.empty());
  expect_mentions(mri.notes.front(),
                  {"of 5 series", "series 4", "second in time of 3", "contrast agent"});
}

TEST(DicomSeries, ALateFinerSeriesIsNotTheDynamicStudy) {
  const EmptyFolder folder("late");
  write_study(folder.path);
  DicomHeader h;
  h.series_number = "24", h.series_uid = "1.2.24", h.acquisition_time = "121500";
  write_dicom_series(folder.path, "24", h, stack(240, 20, 1));
  // What is computed calls itself original, too.
  h.series_number = "7", h.series_uid = "1.2.7", h.acquisition_time = "120100";
  h.image_type = "ORIGINAL\\SECONDARY\\M\\SUB";
  write_dicom_series(folder.path, "7", h, stack(70));
  const Mri mri = read_mri(folder.path);
  EXPECT_EQ(mri.image(0, 0, 0), 40);
  expect_mentions(mri.notes.front(), {"of 7 series", "series 4", "second in time of 3"});
  const auto why = [&](const std::string& number) {
    for (const SeriesRow& row : mri.series)
      if (row.number == number) return row.reason;
    return std::string();
  };
  EXPECT_NE(why("24").find("not of the dynamic study"), std::string::npos);
  EXPECT_NE(why("2").find("2.4 mm"), std::string::npos);
  EXPECT_NE(why("7").find("computed"), std::string::npos);
  EXPECT_NE(why("9").find("before the contrast agent"), std::string::npos);
  EXPECT_NE(why("5").find("later"), std::string::npos);
}

TEST(DicomSeries, TheTomlNamesAnother) {
  const EmptyFolder folder("named");
  write_study(folder.path);
  EXPECT_EQ(read_mri(folder.path, "6").image(0, 0, 0), 60);
  expect_mentions(message_of([&] { read_mri(folder.path, "77"); }),
                  {"mri.series names no series", "series 9"});
}

TEST(DicomSeries, ASliceOfAnotherPatientIsRefusedAndNobodyNamed) {
  const EmptyFolder folder("mixed");
  DicomHeader h;
  h.patient_id = "SECRET1";
  write_dicom_series(folder.path, "a", h, stack(5));
  EXPECT_NO_THROW(read_mri(folder.path));
  h.patient_id = "SECRET2";
  const Eigen::Vector3d x = stack(5).position(0, 0, 7);
  std::ofstream(folder.path / "a0007.dcm", std::ios::binary)
      << dicom_slice_bytes(h, 7, 8, 8, {x.x(), x.y(), x.z()}, 2, std::vector<std::uint16_t>(64, 5));
  const std::string message = message_of([&] { read_mri(folder.path); });
  expect_mentions(message, {"series 1 (20 slices)", "slices of 2 patients", "by PatientID"});
  EXPECT_EQ(message.find("SECRET"), std::string::npos);
}

TEST(DicomSeries, HandsOnHowThePatientLayAndNoName) {
  const EmptyFolder folder("position");
  DicomHeader h;
  h.patient_position = "FFP";
  write_dicom_series(folder.path, "a", h, stack(5));
  EXPECT_EQ(read_mri(folder.path).patient_position, "FFP");
  h.patient_position = "SECRET^NAME";  // not one of DICOM's codes: nothing of it is kept
  write_dicom_series(folder.path, "a", h, stack(5));
  EXPECT_EQ(read_mri(folder.path).patient_position, "");
}

}  // namespace
}  // namespace mammotwin
