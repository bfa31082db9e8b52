#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace mammotwin {

struct Provenance;

/// A hidden file beside a product in which a long stage keeps how far it came, for a later run of
/// the same program on the same inputs with the same parameters. It is gone when a run has ended.
class Checkpoint {
 public:
  Checkpoint(const std::filesystem::path& product, const Provenance& provenance);

  /// What program, inputs and parameters this run is of, as one checksum; what is written must say
  /// it, so that a reader can tell it from another run's.
  const std::string& run() const { return run_; }

  /// Nothing where there is none, or where a byte of it is not as it was written.
  std::optional<std::vector<std::uint8_t>> read() const;

  /// Whole or not at all. A full disk is not an error: the run then cannot be taken up again.
  void write(const std::vector<std::uint8_t>& bytes) const;

  void remove() const;

 private:
  std::filesystem::path path_;
  std::string run_;
};

}  // namespace mammotwin
