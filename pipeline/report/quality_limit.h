#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

namespace mammotwin {

/// What is expected of a figure, and whether it holds.
struct QualityExpectation {
  std::string words;  ///< "at most 1 mm"
  bool held;
};

/// The limit by which stages judge a figure of a product's sidecar, against its value; empty where
/// none is judged or the value is no number. `quality`: the whole object, for limits relative to
/// another figure.
std::optional<QualityExpectation> expectation(const std::string& product, const std::string& key,
                                              const nlohmann::json& quality);

}  // namespace mammotwin
