#include <itkImage.h>
#include <itkImageFileWriter.h>
#include <itkPNGImageIO.h>
#include <itkRGBPixel.h>

#include <stdexcept>

#include "registration/mammogram/findings_picture.h"

namespace mammotwin {

void write_png(const std::filesystem::path& path, const ColourPicture& picture) {
  using Image = itk::Image<itk::RGBPixel<std::uint8_t>, 2>;
  auto image = Image::New();
  image->SetRegions(Image::SizeType{{static_cast<itk::SizeValueType>(picture.columns),
                                     static_cast<itk::SizeValueType>(picture.rows)}});
  image->Allocate();
  for (std::size_t i = 0; i < picture.pixels.size(); ++i)
    for (unsigned c = 0; c < 3; ++c)  // red, green, blue
      image->GetBufferPointer()[i][c] = picture.pixels[i][c];
  auto writer = itk::ImageFileWriter<Image>::New();
  writer->SetImageIO(itk::PNGImageIO::New());
  writer->SetFileName(path.string());
  writer->SetInput(image);
  try {
    writer->Update();
  } catch (const itk::ExceptionObject& error) {
    throw std::runtime_error(path.string() + ": cannot be written: " + error.GetDescription());
  }
}

}  // namespace mammotwin
