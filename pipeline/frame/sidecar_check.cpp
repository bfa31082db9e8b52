#include "pipeline/frame/sidecar_check.h"

#include <algorithm>

#include "pipeline/frame/checksum.h"
#include "pipeline/frame/outcome.h"

namespace mammotwin {
namespace {

using nlohmann::json;

constexpr char kSeal[] = "sidecar_sha256";

bool is_text(const json& value) { return value.is_string(); }
bool is_object(const json& value) { return value.is_object(); }
bool is_amount(const json& value) { return value.is_number() && value.get<double>() >= 0; }
bool is_truth(const json& value) { return value.is_boolean(); }

bool is_checksum(const json& value) {
  constexpr std::size_t digits = 64;
  return value.is_string() && value.get_ref<const std::string&>().size() == digits &&
         value.get_ref<const std::string&>().find_first_not_of("0123456789abcdef") ==
             std::string::npos;
}

bool is_status(const json& value) {
  for (const Status status : {Status::ok, Status::look, Status::refused, Status::not_converged})
    if (value == name_of(status)) return true;
  return false;
}

bool are_texts(const json& value) {
  return value.is_array() && std::all_of(value.begin(), value.end(), is_text);
}

bool is_file(const json& value, const char* named_by) {
  return value.is_object() && value.contains(named_by) && is_text(value[named_by]) &&
         value.contains("sha256") && is_checksum(value["sha256"]);
}

bool are_inputs(const json& value) {
  return value.is_array() && std::all_of(value.begin(), value.end(), [](const json& input) {
           return is_file(input, "role") && (!input.contains("path") || is_text(input["path"]));
         });
}

bool are_outputs(const json& value) {
  return value.is_array() && std::all_of(value.begin(), value.end(), [](const json& output) {
           return is_file(output, "path");
         });
}

struct Field {
  const char* name;
  bool (*fits)(const json&);
  const char* expected;
  bool required = true;
};

constexpr Field kFields[] = {
    {"stage", is_text, "a text"},
    {"version", is_text, "a text"},
    {"program_sha256", is_checksum, "64 hexadecimal digits"},
    {"parameters", is_object, "an object"},
    {"inputs", are_inputs, "a list of {role, sha256}"},
    {"status", is_status, "ok, look, refused or not_converged"},
    {"reasons", are_texts, "a list of texts"},
    {"quality", is_object, "an object"},
    {"command", is_text, "a text"},
    {"seconds", is_amount, "a number of at least 0"},
    {"peak_memory_mb", is_amount, "a number of at least 0"},
    {"outputs", are_outputs, "a list of {path, sha256}"},
    {"starved", is_truth, "true or false", false},
    {kSeal, is_checksum, "64 hexadecimal digits"},
};

/// Short enough for a message.
std::string found(const json& value) {
  constexpr std::size_t most = 40;
  const std::string text = value.dump(-1, ' ', false, json::error_handler_t::replace);
  return text.size() > most ? text.substr(0, most) + "..." : text;
}

std::string checksum_without_seal(json sidecar) {
  sidecar.erase(kSeal);
  return sha256_of_text(sidecar.dump(-1, ' ', false, json::error_handler_t::replace));
}

}  // namespace

std::string schema_fault(const json& sidecar) {
  if (!sidecar.is_object()) return "it is no JSON object; expected a sidecar";
  for (const Field& field : kFields) {
    const auto value = sidecar.find(field.name);
    if (value == sidecar.end()) {
      if (field.required)
        return std::string(field.name) + " is missing; expected " + field.expected;
    } else if (!field.fits(*value)) {
      return std::string(field.name) + " is " + found(*value) + "; expected " + field.expected;
    }
  }
  return {};
}

json sealed(json sidecar) {
  // Through text, so that what a file cannot hold (NaN, bytes that are no UTF-8) is sealed as it
  // is.
  sidecar = json::parse(sidecar.dump(-1, ' ', false, json::error_handler_t::replace));
  sidecar[kSeal] = checksum_without_seal(sidecar);
  return sidecar;
}

bool seal_holds(const json& sidecar) {
  return sidecar.is_object() && sidecar.value(kSeal, json()) == checksum_without_seal(sidecar);
}

}  // namespace mammotwin
