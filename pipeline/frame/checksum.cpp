#include "pipeline/frame/checksum.h"

#include <openssl/evp.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <memory>
#include <stdexcept>
#include <vector>

namespace mammotwin {
namespace {

class Sha256 {
 public:
  Sha256() : context_(EVP_MD_CTX_new(), EVP_MD_CTX_free) {
    EVP_DigestInit_ex(context_.get(), EVP_sha256(), nullptr);
  }

  void add(const char* data, std::size_t size) { EVP_DigestUpdate(context_.get(), data, size); }

  void add_file(const std::filesystem::path& path) {
    if (!std::filesystem::is_regular_file(path))  // a pipe or a device might never end
      throw std::runtime_error(path.string() + ": cannot be read; expected a file or a folder");
    std::ifstream in(path, std::ios::binary);
    std::vector<char> buffer(1 << 18);
    while (in.read(buffer.data(), static_cast<std::streamsize>(buffer.size())) || in.gcount() > 0)
      add(buffer.data(), static_cast<std::size_t>(in.gcount()));
    if (!in.eof()) throw std::runtime_error(path.string() + ": cannot be read");
  }

  std::string hex() {
    std::array<unsigned char, 32> digest{};
    EVP_DigestFinal_ex(context_.get(), digest.data(), nullptr);
    constexpr char digits[] = "0123456789abcdef";
    std::string text;
    for (unsigned char byte : digest) text += {digits[byte >> 4], digits[byte & 15]};
    return text;
  }

 private:
  std::unique_ptr<EVP_MD_CTX, decltype(&EVP_MD_CTX_free)> context_;
};

std::vector<std::filesystem::path> files_below(const std::filesystem::path& folder) {
  std::vector<std::filesystem::path> files;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  return files;
}

}  // namespace

std::string sha256_of_path(const std::filesystem::path& path) {
  Sha256 hash;
  if (!std::filesystem::is_directory(path)) {
    hash.add_file(path);
    return hash.hex();
  }
  for (const auto& file : files_below(path)) {
    const std::string name = std::filesystem::relative(file, path).generic_string();
    hash.add(name.c_str(), name.size() + 1);
    hash.add_file(file);
  }
  return hash.hex();
}

std::string sha256_of_text(const std::string& text) {
  Sha256 hash;
  hash.add(text.data(), text.size());
  return hash.hex();
}

}  // namespace mammotwin
