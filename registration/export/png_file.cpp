#include "registration/export/png_file.h"

#include <itkImage.h>
#include <itkImageFileWriter.h>
#include <itkPNGImageIO.h>

#include <algorithm>
#include <stdexcept>

namespace mammotwin {

void write_png(const std::filesystem::path& path, const GreyPixels& pixels) {
  using Image = itk::Image<std::uint16_t, 2>;
  auto image = Image::New();
  image->SetRegions(Image::SizeType{{static_cast<itk::SizeValueType>(pixels.columns),
                                     static_cast<itk::SizeValueType>(pixels.rows)}});
  image->Allocate();
  std::copy(pixels.grey.begin(), pixels.grey.end(), image->GetBufferPointer());
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
