#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

#include "pipeline/frame/outcome.h"

namespace mammotwin {

/// What decides whether a product is current: which program made it, from which inputs, with which
/// parameters.
struct Provenance {
  std::string stage;
  std::string version;
  std::string program_sha256;
  nlohmann::json parameters;  ///< key -> {value, unit}
  nlohmann::json inputs;      ///< list of {role, sha256}, with a path where that may be said
};

/// A file or folder that a stage reads, and what it is to the stage.
struct StageInput {
  std::string role;  ///< "cc mammogram"; "prone.vtu" for another stage's product
  std::filesystem::path path;
  bool path_may_be_said = false;
};

/// Hashes the inputs; throws std::runtime_error naming an input that is missing. Paths are relative
/// to the product's folder.
Provenance make_provenance(const std::string& stage, const nlohmann::json& parameters,
                           const std::vector<StageInput>& inputs,
                           const std::filesystem::path& product);

nlohmann::json provenance_json(const Provenance& provenance);

/// As the product's sidecar, sealed, whole or not at all. Bytes that are no UTF-8 (of a file's
/// name, say) become U+FFFD. Throws std::runtime_error where it cannot be written.
void write_sidecar(const std::filesystem::path& product, const nlohmann::json& sidecar);

/// results/P/prone.vtu -> results/P/prone.vtu.json.
std::filesystem::path sidecar_path(const std::filesystem::path& product);

struct SidecarFile {
  std::optional<nlohmann::json> sidecar;  ///< where it is as it was written
  std::string fault;                      ///< what is wrong with one that is there
};

/// Reads `<product>.json`: neither a sidecar nor a fault where there is none.
SidecarFile read_sidecar(const std::filesystem::path& product);

/// The reasons why the stage that makes a product found no answer: its sidecar says not_converged
/// and the product is not there. Empty otherwise.
std::vector<std::string> reasons_of_failure(const std::filesystem::path& product);

/// The sidecar of a usable product that this provenance would make again: same program, inputs and
/// parameters, and every file it wrote still has the checksum it had.
std::optional<nlohmann::json> current_sidecar(const std::filesystem::path& product,
                                              const Provenance& provenance);

/// What the run that left this product's sidecar wrote beside it: plain relative paths that do not
/// lead out of the folder; empty where there is no sidecar.
std::vector<std::string> former_outputs(const std::filesystem::path& product);

/// The sidecar of a failure that would come again: refused or not converged with the same program,
/// inputs and parameters, and not for want of memory or room on the disk.
std::optional<nlohmann::json> standing_failure(const std::filesystem::path& product,
                                               const Provenance& provenance);

struct Usage {
  std::string command;
  double seconds = 0;
  double peak_memory_mb = 0;
  bool starved = false;  ///< memory or room on the disk was lacking, which says nothing of the data
};

/// `outputs`: names, beside the product, of all files that were written, as already renamed.
nlohmann::json make_sidecar(const std::filesystem::path& product, const Provenance& provenance,
                            const Outcome& outcome, const std::vector<std::string>& outputs,
                            const Usage& usage);

}  // namespace mammotwin
