#include "pipeline/frame/sidecar.h"

#include <fstream>
#include <regex>
#include <stdexcept>

#include "pipeline/frame/checksum.h"
#include "pipeline/frame/products.h"
#include "pipeline/frame/sidecar_check.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

std::string relative_to(const fs::path& folder, const fs::path& path) {
  return whole_path(path).lexically_relative(whole_path(folder)).generic_string();
}

bool outputs_are_intact(const json& sidecar, const fs::path& folder) {
  for (const json& output : sidecar.at("outputs")) {
    const fs::path path = folder / output.at("path").get<std::string>();
    if (!fs::exists(path) || sha256_of_path(path) != output.at("sha256")) return false;
  }
  return true;
}

/// Sidecars and pages travel: a file is named by its folder and name, not by where it lies here.
std::string without_places(const std::string& reason) {
  static const std::regex absolute(
      R"re((^|[\s"'(])/(?:[^\s/:"'();,]+/)*([^\s/:"'();,]+/[^\s/:"'();,]+))re");
  return std::regex_replace(reason, absolute, "$1$2");
}

/// Discarded where it is not JSON, or nested as no sidecar is.
json parse_shallow(std::istream& in) {
  constexpr int deepest = 64;
  bool too_deep = false;
  json value = json::parse(
      in, [&](int depth, json::parse_event_t, json&) { return !(too_deep |= depth > deepest); },
      false);
  return too_deep ? json(json::value_t::discarded) : value;
}

bool is_of(const json& sidecar, const Provenance& provenance) {
  const json wanted = provenance_json(provenance);
  for (const auto& [key, value] : wanted.items())
    if (!sidecar.contains(key) || sidecar[key] != value) return false;
  return true;
}

bool is_usable(const json& sidecar) {
  const std::string status = sidecar.value("status", "");
  return status == name_of(Status::ok) || status == name_of(Status::look);
}

}  // namespace

json provenance_json(const Provenance& p) {
  return {{"stage", p.stage},
          {"version", p.version},
          {"program_sha256", p.program_sha256},
          {"parameters", p.parameters},
          {"inputs", p.inputs}};
}

Provenance make_provenance(const std::string& stage, const json& parameters,
                           const std::vector<StageInput>& inputs, const fs::path& product) {
  Provenance p{stage, MAMMOTWIN_VERSION, sha256_of_path("/proc/self/exe"), parameters,
               json::array()};
  for (const StageInput& input : inputs) {
    if (!fs::exists(input.path))
      throw std::runtime_error(input.path.string() + ": no such file or folder");
    json entry{{"role", input.role}, {"sha256", sha256_of_path(input.path)}};
    if (input.path_may_be_said) entry["path"] = relative_to(folder_of(product), input.path);
    p.inputs.push_back(std::move(entry));
  }
  return p;
}

void write_sidecar(const fs::path& product, const json& sidecar) {
  constexpr int indent = 1;
  write_text_atomically(sidecar_path(product), sealed(sidecar).dump(indent) + "\n");
}

SidecarFile read_sidecar(const fs::path& product) {
  constexpr std::uintmax_t most_bytes = 64u << 20;  // the largest has some megabytes
  const fs::path path = sidecar_path(product);
  std::error_code none;
  if (!fs::exists(path, none)) return {};
  const std::string again = " (run the stage again)";
  if (!fs::is_regular_file(path, none) || fs::file_size(path, none) > most_bytes)
    return {{}, "it is no file of a sidecar's size" + again};
  std::ifstream in(path);
  json sidecar = parse_shallow(in);
  if (sidecar.is_discarded()) return {{}, "it is not JSON; expected a sidecar" + again};
  if (const std::string fault = schema_fault(sidecar); !fault.empty()) return {{}, fault + again};
  if (!seal_holds(sidecar))
    return {{}, "it was edited after it was written: its checksum differs" + again};
  return {std::move(sidecar), {}};
}

fs::path sidecar_path(const fs::path& product) {
  fs::path path = product;
  return path += ".json";
}

std::optional<json> current_sidecar(const fs::path& product, const Provenance& provenance) {
  const auto sidecar = read_sidecar(product).sidecar;
  if (!sidecar || !is_usable(*sidecar) || !is_of(*sidecar, provenance)) return std::nullopt;
  if (!outputs_are_intact(*sidecar, folder_of(product))) return std::nullopt;
  return sidecar;
}

std::vector<std::string> former_outputs(const fs::path& product) {
  std::vector<std::string> names;
  const auto sidecar = read_sidecar(product).sidecar;
  if (!sidecar) return names;
  for (const json& output : (*sidecar)["outputs"]) {
    const fs::path name = fs::path(output["path"].get<std::string>()).lexically_normal();
    if (!name.empty() && name.is_relative() && *name.begin() != "..")
      names.push_back(name.generic_string());
  }
  return names;
}

std::vector<std::string> reasons_of_failure(const fs::path& product) {
  std::error_code none;
  if (fs::exists(product, none)) return {};
  const auto sidecar = read_sidecar(product).sidecar;
  if (!sidecar || (*sidecar)["status"] != name_of(Status::not_converged)) return {};
  return (*sidecar)["reasons"].get<std::vector<std::string>>();
}

std::optional<json> standing_failure(const fs::path& product, const Provenance& provenance) {
  const auto sidecar = read_sidecar(product).sidecar;
  if (!sidecar || is_usable(*sidecar) || !is_of(*sidecar, provenance)) return std::nullopt;
  if (sidecar->value("starved", true)) return std::nullopt;
  return sidecar;
}

json make_sidecar(const fs::path& product, const Provenance& provenance, const Outcome& outcome,
                  const std::vector<std::string>& outputs, const Usage& usage) {
  json sidecar = provenance_json(provenance);
  sidecar["status"] = name_of(outcome.status);
  sidecar["reasons"] = json::array();
  for (const std::string& reason : outcome.reasons)
    sidecar["reasons"].push_back(without_places(reason));
  sidecar["quality"] = outcome.quality.is_null() ? json::object() : outcome.quality;
  sidecar["command"] = usage.command;
  sidecar["seconds"] = usage.seconds;
  sidecar["peak_memory_mb"] = usage.peak_memory_mb;
  if (!outcome.usable()) sidecar["starved"] = usage.starved;
  sidecar["outputs"] = json::array();
  for (const std::string& name : outputs)
    sidecar["outputs"].push_back(
        {{"path", name}, {"sha256", sha256_of_path(folder_of(product) / name)}});
  return sidecar;
}

}  // namespace mammotwin
