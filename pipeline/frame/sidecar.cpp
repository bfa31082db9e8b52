#include "pipeline/frame/sidecar.h"

#include <fstream>
#include <regex>
#include <stdexcept>

#include "pipeline/frame/checksum.h"
#include "pipeline/frame/products.h"

namespace mammotwin {
namespace {

namespace fs = std::filesystem;
using nlohmann::json;

/// A relative path of which nothing exists yet would stay relative in weakly_canonical.
fs::path whole(const fs::path& path) { return fs::weakly_canonical(fs::absolute(path)); }

std::string relative_to(const fs::path& folder, const fs::path& path) {
  return whole(path).lexically_relative(whole(folder)).generic_string();
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

json read_json(const fs::path& path) {
  std::ifstream in(path);
  return in ? json::parse(in, nullptr, false) : json();
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
                           const std::vector<fs::path>& inputs, const fs::path& product) {
  Provenance p{stage, MAMMOTWIN_VERSION, sha256_of_path("/proc/self/exe"), parameters,
               json::array()};
  for (const fs::path& input : inputs) {
    if (!fs::exists(input)) throw std::runtime_error(input.string() + ": no such file or folder");
    p.inputs.push_back(
        {{"path", relative_to(folder_of(product), input)}, {"sha256", sha256_of_path(input)}});
  }
  return p;
}

void write_sidecar(const fs::path& product, const json& sidecar) {
  constexpr int indent = 1;
  const std::string text = sidecar.dump(indent, ' ', false, json::error_handler_t::replace);
  write_text_atomically(sidecar_path(product), text + "\n");
}

fs::path sidecar_path(const fs::path& product) {
  fs::path path = product;
  return path += ".json";
}

std::optional<json> current_sidecar(const fs::path& product, const Provenance& provenance) {
  const json sidecar = read_json(sidecar_path(product));
  if (!sidecar.is_object() || !is_usable(sidecar) || !is_of(sidecar, provenance))
    return std::nullopt;
  if (!sidecar.contains("outputs") || !outputs_are_intact(sidecar, folder_of(product)))
    return std::nullopt;
  return sidecar;
}

std::vector<std::string> former_outputs(const fs::path& product) {
  const json sidecar = read_json(sidecar_path(product));
  std::vector<std::string> names;
  if (!sidecar.is_object() || !sidecar.contains("outputs")) return names;
  for (const json& output : sidecar["outputs"]) {
    const fs::path name = fs::path(output.value("path", "")).lexically_normal();
    if (!name.empty() && name.is_relative() && *name.begin() != "..")
      names.push_back(name.generic_string());
  }
  return names;
}

std::optional<json> standing_failure(const fs::path& product, const Provenance& provenance) {
  const json sidecar = read_json(sidecar_path(product));
  if (!sidecar.is_object() || is_usable(sidecar) || !is_of(sidecar, provenance))
    return std::nullopt;
  if (sidecar.value("starved", true)) return std::nullopt;
  return sidecar;
}

json make_sidecar(const fs::path& product, const Provenance& provenance, const Outcome& outcome,
                  const std::vector<std::string>& outputs, const Usage& usage) {
  json sidecar = provenance_json(provenance);
  sidecar["status"] = name_of(outcome.status);
  sidecar["reasons"] = json::array();
  for (const std::string& reason : outcome.reasons)
    sidecar["reasons"].push_back(without_places(reason));
  sidecar["quality"] = outcome.quality;
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
