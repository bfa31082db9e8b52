#pragma once

#include <string>

namespace mammotwin {

/// What a file of a result folder is and what opens it, in words; empty for one that nobody opens
/// (sidecars, the page itself).
std::string described_file(const std::string& name);

}  // namespace mammotwin
