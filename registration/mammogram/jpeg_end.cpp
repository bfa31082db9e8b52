#include "registration/mammogram/jpeg_end.h"

#include <fstream>
#include <iterator>
#include <string>

namespace mammotwin {
namespace {

// Second bytes of markers, T.81 table B.1.
constexpr unsigned kStuffed = 0x00, kTem = 0x01, kRst0 = 0xd0, kSoi = 0xd8, kEoi = 0xd9,
                   kSos = 0xda, kFill = 0xff;

unsigned byte_at(const std::string& bytes, std::size_t at) {
  return static_cast<unsigned char>(bytes[at]);
}

bool has_no_length(unsigned marker) {
  return marker == kTem || (marker >= kRst0 && marker <= kSoi);
}

/// Behind coded data: the next marker that is not one of a restart.
std::size_t end_of_coded_data(const std::string& bytes, std::size_t at) {
  for (; at + 1 < bytes.size(); ++at)
    if (const unsigned next = byte_at(bytes, at + 1);
        byte_at(bytes, at) == 0xff && next != kStuffed && next != kFill && !has_no_length(next))
      return at;
  return bytes.size();
}

}  // namespace

bool has_jpeg_end(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  const std::string bytes(std::istreambuf_iterator<char>(in), {});
  for (std::size_t at = 0; at + 1 < bytes.size();) {
    if (byte_at(bytes, at) != 0xff) return false;
    const unsigned marker = byte_at(bytes, at + 1);
    if (marker == kEoi) return true;
    if (marker == kFill) {
      ++at;
    } else if (has_no_length(marker)) {
      at += 2;
    } else if (at + 3 < bytes.size()) {
      at += 2 + 256 * byte_at(bytes, at + 2) + byte_at(bytes, at + 3);
      if (marker == kSos) at = end_of_coded_data(bytes, at);
    } else {
      return false;
    }
  }
  return false;
}

}  // namespace mammotwin
