#include "registration/export/png_file.h"

#include <itkImage.h>
#include <itkImageFileWriter.h>
#include <itkPNGImageIO.h>
#include <itkRGBPixel.h>

#include <algorithm>
#include <stdexcept>

#include "registration/mammogram/findings_picture.h"

namespace mammotwin {
namespace {

template <class Pixel>
void write(const std::filesystem::path& path, int columns, int rows,
           const std::vector<Pixel>& pixels) {
  using Image = itk::Image<Pixel, 2>;
  const auto image = Image::New();
  image->SetRegions(itk::Size<2>{
      {static_cast<itk::SizeValueType>(columns), static_cast<itk::SizeValueType>(rows)}});
  image->Allocate();
  std::copy(pixels.begin(), pixels.end(), image->GetBufferPointer());
  const auto writer = itk::ImageFileWriter<Image>::New();
  writer->SetImageIO(itk::PNGImageIO::New());
  writer->SetFileName(path.string());
  writer->SetInput(image);
  try {
    writer->Update();
  } catch (const itk::ExceptionObject& error) {
    throw std::runtime_error(path.string() + ": cannot be written: " + error.GetDescription());
  }
}

}  // namespace

void write_png(const std::filesystem::path& path, const GreyPixels& pixels) {
  write(path, pixels.columns, pixels.rows, pixels.grey);
}

void write_png(const std::filesystem::path& path, const ColourPicture& picture) {
  std::vector<itk::RGBPixel<std::uint8_t>> pixels;
  pixels.reserve(picture.pixels.size());
  for (const ColourPicture::Colour& colour : picture.pixels) pixels.emplace_back(colour.data());
  write(path, picture.columns, picture.rows, pixels);
}

}  // namespace mammotwin
