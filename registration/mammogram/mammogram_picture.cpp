#include "registration/mammogram/mammogram_picture.h"

#include <itkImageFileReader.h>
#include <itkJPEGImageIO.h>
#include <itkPNGImageIO.h>
#include <itkVectorImage.h>
#include <png.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>
#include <stdexcept>
#include <string_view>

#include "registration/mammogram/jpeg_end.h"

namespace mammotwin {
namespace {

using Channels = itk::VectorImage<float, 2>;

bool begins_with(const std::filesystem::path& path, std::string_view signature) {
  std::array<char, 8> first{};
  std::ifstream in(path, std::ios::binary);
  in.read(first.data(), static_cast<std::streamsize>(signature.size()));
  return in && std::string_view(first.data(), signature.size()) == signature;
}

bool is_png(const std::filesystem::path& path) {
  return begins_with(path, "\x89PNG\r\n\x1a\n");  // PNG specification, 5.2
}

bool is_jpeg(const std::filesystem::path& path) {
  return begins_with(path, "\xff\xd8\xff");  // ITU-T T.81, B.1.1.3: start of image, a marker
}

/// The grey of a pixel; of colour the first channel, whose others must be the same.
float grey_of(const float* pixel, unsigned channels, const std::filesystem::path& path) {
  constexpr unsigned kColours = 3;
  constexpr float kDiffer = 8;  // of 255; what JPEG makes of equal channels differs by 2
  if (channels < kColours) return pixel[0];
  const auto [low, high] = std::minmax_element(pixel, pixel + kColours);
  if (*high - *low > kDiffer)
    throw std::runtime_error(path.string() +
                             ": is in colour, and its channels differ; expected a grey mammogram "
                             "(export it again without coloured marks)");
  return pixel[0];
}

constexpr double kMostPixels = 1 << 28;  // six times the largest detector's

/// ITK's PNG reader ends the program over a header that libpng refuses: libpng is asked first.
void check_png_header(const std::filesystem::path& path) {
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  const bool whole = png_image_begin_read_from_file(&header, path.c_str()) != 0;
  const double pixels = static_cast<double>(header.width) * header.height;
  png_image_free(&header);
  if (!whole)
    throw std::runtime_error(path.string() + ": is no whole PNG image (" + header.message +
                             "); export or copy it again");
  if (pixels > kMostPixels)
    throw std::runtime_error(path.string() + ": its header asks for " +
                             std::to_string(header.width) + " x " + std::to_string(header.height) +
                             " pixels; expected at most 2^28 of them (is it damaged?)");
}

[[noreturn]] void cannot_be_read(const std::filesystem::path& path) {
  throw std::runtime_error(path.string() +
                           ": its pixels cannot be read, the file is truncated or damaged; "
                           "export or copy it again");
}

itk::ImageIOBase::Pointer io_for(const std::filesystem::path& path) {
  if (!is_png(path)) {
    if (!has_jpeg_end(path)) cannot_be_read(path);
    return itk::JPEGImageIO::New().GetPointer();
  }
  check_png_header(path);
  return itk::PNGImageIO::New().GetPointer();
}

Channels::Pointer read_channels(const std::filesystem::path& path) {
  auto reader = itk::ImageFileReader<Channels>::New();
  reader->SetFileName(path.string());
  reader->SetImageIO(io_for(path));
  try {
    reader->Update();
  } catch (const itk::ExceptionObject&) {
    cannot_be_read(path);
  }
  return reader->GetOutput();
}

}  // namespace

bool is_mammogram_picture(const std::filesystem::path& path) {
  return is_png(path) || is_jpeg(path);
}

MammogramImage read_mammogram_picture(const std::filesystem::path& path) {
  if (!std::filesystem::exists(path)) throw std::runtime_error(path.string() + ": no such file");
  if (!is_mammogram_picture(path))
    throw std::runtime_error(path.string() +
                             ": not a PNG or JPEG image; expected a grey mammogram");
  const Channels::Pointer read = read_channels(path);
  const auto size = read->GetLargestPossibleRegion().GetSize();
  const unsigned channels = read->GetNumberOfComponentsPerPixel();
  MammogramImage image{static_cast<int>(size[0]), static_cast<int>(size[1]), {}};
  image.grey.reserve(size[0] * size[1]);
  const float* pixel = read->GetBufferPointer();
  for (std::size_t i = 0; i < size[0] * size[1]; ++i, pixel += channels)
    image.grey.push_back(grey_of(pixel, channels, path));
  return image;
}

PictureSize mammogram_picture_size(const std::filesystem::path& path) {
  const itk::ImageIOBase::Pointer io = io_for(path);
  io->SetFileName(path.string());
  try {
    io->ReadImageInformation();
  } catch (const itk::ExceptionObject&) {
    cannot_be_read(path);
  }
  return {static_cast<int>(io->GetDimensions(0)), static_cast<int>(io->GetDimensions(1))};
}

}  // namespace mammotwin
