#include "pipeline/frame/checkpoint.h"

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "pipeline/frame/checksum.h"
#include "pipeline/frame/partial_path.h"
#include "pipeline/frame/products.h"
#include "pipeline/frame/sidecar.h"

namespace mammotwin {

namespace fs = std::filesystem;

namespace {
constexpr std::size_t kChecksumDigits = 64;  // SHA-256 in hexadecimal, before the bytes
}

Checkpoint::Checkpoint(const fs::path& product, const Provenance& provenance)
    : path_(product.parent_path() / ("." + product.filename().string() + ".checkpoint")),
      run_(sha256_of_text(provenance_json(provenance).dump())) {}

std::optional<std::vector<std::uint8_t>> Checkpoint::read() const {
  std::ifstream in(path_, std::ios::binary);
  if (!in) return std::nullopt;
  const std::string file(std::istreambuf_iterator<char>(in), {});
  if (file.size() < kChecksumDigits) return std::nullopt;
  const std::string bytes = file.substr(kChecksumDigits);
  if (sha256_of_text(bytes) != file.substr(0, kChecksumDigits)) return std::nullopt;
  return std::vector<std::uint8_t>(bytes.begin(), bytes.end());
}

void Checkpoint::write(const std::vector<std::uint8_t>& bytes) const {
  try {
    const std::string text(bytes.begin(), bytes.end());
    write_text_atomically(path_, sha256_of_text(text) + text);
  } catch (const std::runtime_error&) {
    remove();
  }
}

void Checkpoint::remove() const {
  std::error_code ignored;
  fs::remove(path_, ignored);
  remove_partial_leftovers(path_.parent_path(), path_.filename().string());
}

}  // namespace mammotwin
