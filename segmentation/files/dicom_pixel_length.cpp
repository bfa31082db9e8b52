#include "segmentation/files/dicom_pixel_length.h"

#include <gdcmReader.h>
#include <gdcmTransferSyntax.h>

#include <array>
#include <fstream>
#include <stdexcept>
#include <string>

namespace mammotwin {
namespace {

// Tags as they are read, little-endian: the group in the lower half.
constexpr std::uint32_t item_tag = 0xe000fffe, end_of_items = 0xe0ddfffe;

std::uint32_t little_endian_number(std::istream& in) {
  std::array<unsigned char, 4> b{};
  in.read(reinterpret_cast<char*>(b.data()), b.size());
  return b[0] | b[1] << 8 | b[2] << 16 | static_cast<std::uint32_t>(b[3]) << 24;
}

/// Items follow each other to a delimiter; false where the file ends before.
bool items_end(std::ifstream& in, std::uintmax_t at, std::uintmax_t size) {
  constexpr std::uintmax_t item_header = 8;
  while (at + item_header <= size) {
    in.seekg(static_cast<std::streamoff>(at));
    const std::uint32_t tag = little_endian_number(in), length = little_endian_number(in);
    if (tag == end_of_items) return true;
    if (tag != item_tag) return false;
    at += item_header + length;
  }
  return false;
}

[[noreturn]] void fail_short(const std::string& found) {
  throw std::runtime_error("is truncated: " + found + " (copy or export it again)");
}

}  // namespace

void check_pixels_whole(const std::filesystem::path& file, std::uintmax_t expected) {
  const gdcm::Tag pixel_data(0x7fe0, 0x0010);
  gdcm::Reader reader;
  reader.SetFileName(file.c_str());
  if (!reader.ReadUpToTag(pixel_data, {pixel_data}))  // and stop before its value
    throw std::runtime_error("its header cannot be read; expected a DICOM file");
  const gdcm::TransferSyntax& syntax = reader.GetFile().GetHeader().GetDataSetTransferSyntax();
  if (syntax == gdcm::TransferSyntax::DeflatedExplicitVRLittleEndian ||
      syntax.GetSwapCode() == gdcm::SwapCode::BigEndian)
    return;  // their bytes are not the file's; both are retired
  std::ifstream in(file, std::ios::binary);
  const std::uintmax_t size = std::filesystem::file_size(file);
  const std::uintmax_t begin = reader.GetStreamCurrentPosition();
  if (syntax.IsEncapsulated()) {
    if (!items_end(in, begin, size)) fail_short("its compressed pixel data do not end");
  } else if (size < begin + expected) {
    fail_short(std::to_string(size > begin ? size - begin : 0) + " bytes of pixels; expected " +
               std::to_string(expected));
  }
}

}  // namespace mammotwin
