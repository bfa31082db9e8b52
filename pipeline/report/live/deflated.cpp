#include "pipeline/report/live/deflated.h"

#include <zlib.h>

#include <stdexcept>

#include "pipeline/report/live/base64.h"

namespace mammotwin {

std::string deflated(const std::vector<std::uint8_t>& bytes) {
  uLongf size = compressBound(bytes.size());
  std::vector<std::uint8_t> packed(size);
  if (compress2(packed.data(), &size, bytes.data(), bytes.size(), Z_DEFAULT_COMPRESSION) != Z_OK)
    throw std::runtime_error("report: zlib could not pack what the page carries");
  return base64(packed.data(), size);
}

}  // namespace mammotwin
