#include "pipeline/report/live/base64.h"

#include <openssl/evp.h>

namespace mammotwin {

std::string base64(const void* data, std::size_t bytes) {
  std::string text(4 * ((bytes + 2) / 3) + 1, '\0');  // EVP_EncodeBlock ends with a zero
  const int length =
      EVP_EncodeBlock(reinterpret_cast<unsigned char*>(text.data()),
                      static_cast<const unsigned char*>(data), static_cast<int>(bytes));
  text.resize(length);
  return text;
}

std::string data_uri(const std::string& media_type, const std::string& content) {
  return "data:" + media_type + ";base64," + base64(content.data(), content.size());
}

}  // namespace mammotwin
