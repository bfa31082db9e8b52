#pragma once

namespace mammotwin {

/// The value where it is positive and finite; else throws std::invalid_argument that names the
/// modulus, what was found and what is expected.
double positive_modulus(const char* name, double value);

}  // namespace mammotwin
