#include "registration/mammogram/mammogram_picture.h"

#include <gtest/gtest.h>
#include <itkImage.h>
#include <itkImageFileWriter.h>
#include <itkJPEGImageIO.h>
#include <itkPNGImageIO.h>
#include <itkRGBPixel.h>
#include <unistd.h>

#include <filesystem>

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using Colour = itk::RGBPixel<std::uint8_t>;
constexpr int kWide = 48, kHigh = 32;

/// A slope of greys from left to right; `red`: how much redder the last column is.
fs::path written(const char* extension, int red) {
  using Image = itk::Image<Colour, 2>;
  auto image = Image::New();
  image->SetRegions(Image::SizeType{{kWide, kHigh}});
  image->Allocate();
  for (int row = 0; row < kHigh; ++row)
    for (int column = 0; column < kWide; ++column) {
      Colour colour;
      colour.Fill(static_cast<std::uint8_t>(4 * column));
      if (column == kWide - 1) colour.SetRed(static_cast<std::uint8_t>(4 * column + red));
      image->SetPixel({{column, row}}, colour);
    }
  const fs::path path =
      fs::temp_directory_path() / ("picture_" + std::to_string(getpid()) + extension);
  auto writer = itk::ImageFileWriter<Image>::New();
  writer->SetFileName(path.string());
  if (std::string(extension) == ".png")
    writer->SetImageIO(itk::PNGImageIO::New());
  else
    writer->SetImageIO(itk::JPEGImageIO::New());
  writer->SetInput(image);
  writer->Update();
  return path;
}

TEST(MammogramPicture, ColourThatIsGreyIsReadFromPngAndJpeg) {
  for (const auto& [extension, tolerance] : {std::pair(".png", 0), std::pair(".jpg", 4)}) {
    const fs::path path = written(extension, 0);
    EXPECT_TRUE(is_mammogram_picture(path));
    const MammogramImage image = read_mammogram_picture(path);
    EXPECT_EQ(image.columns, kWide);
    EXPECT_EQ(image.rows, kHigh);
    EXPECT_NEAR(image.at(20, 9), 80, tolerance) << extension;  // JPEG loses a little
    fs::remove(path);
  }
}

// Wherever it ends; a JPEG that libjpeg would fill up, too.
TEST(MammogramPicture, OneThatEndsEarlyIsRefused) {
  for (const char* extension : {".png", ".jpg"}) {
    const fs::path path = written(extension, 0);
    for (std::uintmax_t size = fs::file_size(path) - 1; size > 20; size -= 5) {
      fs::resize_file(path, size);
      EXPECT_THROW(read_mammogram_picture(path), std::runtime_error)
          << extension << " of " << size << " bytes";
    }
    fs::remove(path);
  }
}

TEST(MammogramPicture, ColouredMarksAreRefused) {
  const fs::path path = written(".png", 60);
  EXPECT_THROW(read_mammogram_picture(path), std::runtime_error);
  fs::remove(path);
}

}  // namespace
}  // namespace mammotwin
