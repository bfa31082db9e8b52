#include "segmentation/files/read_raw_image.h"

#include <itkMetaDataObject.h>
#include <itkMetaImageIO.h>
#include <itkNiftiImageIO.h>
#include <itkNrrdImageIO.h>

#include <cmath>
#include <stdexcept>

#include "segmentation/files/check_meta_header.h"
#include "segmentation/files/inspect_nifti.h"
#include "segmentation/files/trial_read.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t most_voxels = std::size_t{1} << 28;  // 1 GB as float, 12 times a usual scan
constexpr double least_spacing_mm = 0.05, most_spacing_mm = 20;

bool ends_with(const std::string& name, const std::string& ending) {
  return name.size() >= ending.size() &&
         name.compare(name.size() - ending.size(), ending.size(), ending) == 0;
}

std::string lower_name(const fs::path& path) {
  std::string name = path.filename().string();
  for (char& c : name) c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  return name;
}

bool is_nifti(const std::string& name) {
  return ends_with(name, ".nii") || ends_with(name, ".nii.gz");
}
bool is_nrrd(const std::string& name) {
  return ends_with(name, ".nrrd") || ends_with(name, ".nhdr");
}
bool is_meta(const std::string& name) { return ends_with(name, ".mha") || ends_with(name, ".mhd"); }

itk::ImageIOBase::Pointer io_for(const std::string& name) {
  if (is_nifti(name)) return itk::NiftiImageIO::New().GetPointer();
  if (is_nrrd(name)) return itk::NrrdImageIO::New().GetPointer();
  return itk::MetaImageIO::New().GetPointer();
}

constexpr const char* kUnknownNumbers = "has an unknown kind of number; expected grey values";

void check_dimensions(const itk::ImageIOBase& io, unsigned components) {
  if (io.GetComponentType() == itk::IOComponentEnum::UNKNOWNCOMPONENTTYPE)
    throw std::runtime_error(kUnknownNumbers);
  const unsigned dimensions = io.GetNumberOfDimensions();
  bool spatial = dimensions >= 3;
  for (unsigned d = 0; d < std::min(3u, dimensions); ++d) spatial &= io.GetDimensions(d) > 1;
  if (!spatial)
    throw std::runtime_error("is a two-dimensional image; expected a three-dimensional breast MRI");
  for (unsigned d = 3; d < dimensions; ++d)
    if (io.GetDimensions(d) != 1)
      throw std::runtime_error("holds " + std::to_string(io.GetDimensions(d)) +
                               " volumes; expected one (save the phase to be used on its own)");
  if (io.GetNumberOfComponents() != components)
    throw std::runtime_error("has " + std::to_string(io.GetNumberOfComponents()) +
                             " value(s) a voxel; expected " + std::to_string(components));
  double voxels = 1;
  for (unsigned d = 0; d < 3; ++d) voxels *= static_cast<double>(io.GetDimensions(d));
  if (voxels > static_cast<double>(most_voxels))
    throw std::runtime_error("its header asks for " + std::to_string(io.GetDimensions(0)) + " x " +
                             std::to_string(io.GetDimensions(1)) + " x " +
                             std::to_string(io.GetDimensions(2)) + " voxels; expected at most " +
                             std::to_string(most_voxels) + " (is the header damaged?)");
}

void check_spacing(const itk::ImageIOBase& io) {
  for (unsigned d = 0; d < 3; ++d) {
    const double s = io.GetSpacing(d);
    if (s >= least_spacing_mm && s <= most_spacing_mm) continue;
    throw std::runtime_error("spacing of axis " + std::to_string(d) + " is " + std::to_string(s) +
                             "; expected 0.05 to 20 mm (is it in cm or m?)");
  }
}

/// niftilib fills missing voxels with zeros and turns NaN to 0 without a word: look before.
void check_nifti(const fs::path& path, const itk::ImageIOBase& io) {
  if (!is_nifti(lower_name(path))) return;
  const auto expected = static_cast<std::uintmax_t>(io.GetImageSizeInBytes());
  const bool floating = io.GetComponentType() == itk::IOComponentEnum::FLOAT ||
                        io.GetComponentType() == itk::IOComponentEnum::DOUBLE;
  const NiftiVoxels found =
      inspect_nifti(path, static_cast<int>(io.GetComponentSize()), floating, expected);
  if (found.bytes < expected)
    throw std::runtime_error("is truncated: " + std::to_string(found.bytes) +
                             " bytes of voxels; expected " + std::to_string(expected) +
                             " (copy or export it again)");
  if (found.not_finite > 0)
    throw std::runtime_error("has " + std::to_string(found.not_finite) +
                             " values that are not finite (NaN or infinite); expected numbers "
                             "only (replace them before)");
}

void check_meta(const fs::path& path, const itk::ImageIOBase& io) {
  if (is_meta(lower_name(path)))
    check_meta_voxels(path, read_meta_header(path),
                      static_cast<std::uintmax_t>(io.GetImageSizeInBytes()));
}

itk::ImageIOBase::Pointer open_header(const fs::path& path) {
  const itk::ImageIOBase::Pointer io = io_for(lower_name(path));
  io->SetFileName(path.string());
  io->ReadImageInformation();
  return io;
}

/// The libraries end the program over some damaged headers, and never end over others: another
/// program tries first.
itk::ImageIOBase::Pointer read_header(const fs::path& path) {
  const std::string name = lower_name(path);
  if (is_meta(name)) read_meta_header(path);
  if (is_nifti(name)) check_nifti_placement(path);
  const char* damaged =
      "its header cannot be read; expected a NIfTI, NRRD or MetaImage file (is it damaged?)";
  if (const auto failed = first_fatal(Trial::raw_header, {path}))
    throw std::runtime_error(failed->timed_out
                                 ? "its header could not be read within a minute; expected a "
                                   "NIfTI, NRRD or MetaImage file (is it damaged, or does its "
                                   "disk not answer?)"
                                 : damaged);
  try {
    return open_header(path);
  } catch (const itk::ExceptionObject&) {
    throw std::runtime_error(damaged);
  }
}

template <class T>
std::vector<float> as_floats(const std::vector<char>& bytes) {
  const T* first = reinterpret_cast<const T*>(bytes.data());
  return {first, first + bytes.size() / sizeof(T)};
}

std::vector<float> as_floats(const std::vector<char>& bytes, itk::IOComponentEnum type) {
  using C = itk::IOComponentEnum;
  switch (type) {
    case C::UCHAR:
      return as_floats<unsigned char>(bytes);
    case C::CHAR:
      return as_floats<signed char>(bytes);
    case C::USHORT:
      return as_floats<unsigned short>(bytes);
    case C::SHORT:
      return as_floats<short>(bytes);
    case C::UINT:
      return as_floats<unsigned int>(bytes);
    case C::INT:
      return as_floats<int>(bytes);
    case C::ULONG:
      return as_floats<unsigned long>(bytes);
    case C::LONG:
      return as_floats<long>(bytes);
    case C::DOUBLE:
      return as_floats<double>(bytes);
    default:
      throw std::runtime_error(kUnknownNumbers);
  }
}

void read_bytes(itk::ImageIOBase& io, void* bytes) {
  try {
    io.Read(bytes);
  } catch (const itk::ExceptionObject&) {
    throw std::runtime_error("its voxels cannot be read; expected " +
                             std::to_string(io.GetImageSizeInBytes()) +
                             " bytes of them, the file is truncated or damaged (copy or export it "
                             "again)");
  }
}

std::vector<float> read_values(itk::ImageIOBase& io) {
  const auto size = static_cast<std::size_t>(io.GetImageSizeInBytes());
  if (io.GetComponentType() == itk::IOComponentEnum::FLOAT) {
    std::vector<float> values(size / sizeof(float));
    read_bytes(io, values.data());
    return values;
  }
  std::vector<char> bytes(size);
  read_bytes(io, bytes.data());
  return as_floats(bytes, io.GetComponentType());
}

void collect_keys(const itk::ImageIOBase& io, HeaderKeys& keys) {
  const itk::MetaDataDictionary& dictionary = io.GetMetaDataDictionary();
  for (const std::string& key : dictionary.GetKeys())
    if (std::string value; itk::ExposeMetaData(dictionary, key, value)) keys[key] = value;
}

}  // namespace

bool is_image_file_name(const fs::path& path) {
  const std::string name = lower_name(path);
  return is_nifti(name) || is_nrrd(name) || is_meta(name);
}

void try_raw_header(const fs::path& path) { open_header(path); }

RawImage read_raw_image(const fs::path& path, HeaderKeys* keys, int components) {
  const itk::ImageIOBase::Pointer io = read_header(path);
  RawImage image;
  check_dimensions(*io, static_cast<unsigned>(components));
  check_spacing(*io);
  check_nifti(path, *io);
  check_meta(path, *io);
  itk::ImageIORegion region(io->GetNumberOfDimensions());
  for (unsigned d = 0; d < io->GetNumberOfDimensions(); ++d)
    region.SetSize(d, io->GetDimensions(d));
  io->SetIORegion(region);
  image.values = read_values(*io);
  for (int d = 0; d < 3; ++d) {
    image.size[d] = static_cast<int>(io->GetDimensions(d));
    image.spacing[d] = io->GetSpacing(d);
    image.origin[d] = io->GetOrigin(d);
    for (int r = 0; r < 3; ++r) image.direction[3 * r + d] = io->GetDirection(d)[r];
  }
  if (keys) collect_keys(*io, *keys);
  return image;
}

}  // namespace mammotwin
