#include "pipeline/frame/checkpoint.h"

#include <fstream>
#include <iterator>
#include <stdexcept>

#include "pipeline/frame/checksum.h"
#include "pipeline/frame/products.h"
#include "pipeline/frame/sidecar.h"

namespace mammotwin {

namespace fs = std::filesystem;

Checkpoint::Checkpoint(const fs::path& product, const Provenance& provenance)
    : path_(product.parent_path() / ("." + product.filename().string() + ".checkpoint")),
      run_(sha256_of_text(provenance_json(provenance).dump())) {}

std::optional<std::vector<std::uint8_t>> Checkpoint::read() const {
  std::ifstream in(path_, std::ios::binary);
  if (!in) return std::nullopt;
  return std::vector<std::uint8_t>(std::istreambuf_iterator<char>(in), {});
}

void Checkpoint::write(const std::vector<std::uint8_t>& bytes) const {
  try {
    write_text_atomically(path_, {bytes.begin(), bytes.end()});
  } catch (const std::runtime_error&) {
    remove();
  }
}

void Checkpoint::remove() const {
  std::error_code ignored;
  fs::remove(path_, ignored);
}

}  // namespace mammotwin
