#include "segmentation/files/write_image_file.h"

#include <itkMetaDataObject.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>

#include <stdexcept>

namespace mammotwin {
namespace {

template <class ImageIO, class T>
void write(const std::filesystem::path& path, const FileGrid& grid, const T* values, int components,
           const std::map<std::string, std::string>& keys) {
  const typename ImageIO::Pointer io = ImageIO::New();
  io->SetFileName(path.string());
  io->SetNumberOfDimensions(3);
  itk::ImageIORegion region(3);
  for (unsigned d = 0; d < 3; ++d) {
    io->SetDimensions(d, grid.size[d]);
    io->SetSpacing(d, grid.spacing[d]);
    io->SetOrigin(d, grid.origin[d]);
    std::vector<double> axis(3, 0);
    axis[d] = 1;
    io->SetDirection(d, axis);
    region.SetSize(d, grid.size[d]);
  }
  io->SetIORegion(region);
  io->SetNumberOfComponents(components);
  io->SetPixelType(components == 1 ? itk::IOPixelEnum::SCALAR : itk::IOPixelEnum::VECTOR);
  io->SetComponentType(itk::ImageIOBase::MapPixelType<T>::CType);
  io->SetUseCompression(true);
  for (const auto& [key, value] : keys)
    itk::EncapsulateMetaData<std::string>(io->GetMetaDataDictionary(), key, value);
  try {
    io->Write(values);
  } catch (const itk::ExceptionObject&) {
    throw std::runtime_error(path.string() +
                             ": cannot be written; expected a folder that exists, may be written "
                             "to and has room");
  }
}

}  // namespace

void write_nrrd(const std::filesystem::path& path, const FileGrid& grid, const float* values,
                int components, const std::map<std::string, std::string>& keys) {
  write<itk::NrrdImageIO>(path, grid, values, components, keys);
}

void write_nrrd(const std::filesystem::path& path, const FileGrid& grid, const std::uint8_t* values,
                int components, const std::map<std::string, std::string>& keys) {
  write<itk::NrrdImageIO>(path, grid, values, components, keys);
}

void write_nifti(const std::filesystem::path& path, const FileGrid& grid, const float* values) {
  write<itk::NiftiImageIO>(path, grid, values, 1, {});
}

void write_nifti(const std::filesystem::path& path, const FileGrid& grid,
                 const std::uint8_t* values) {
  write<itk::NiftiImageIO>(path, grid, values, 1, {});
}

}  // namespace mammotwin
