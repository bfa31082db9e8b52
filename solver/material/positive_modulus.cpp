#include "solver/material/positive_modulus.h"

#include <cmath>
#include <stdexcept>
#include <string>

namespace mammotwin {

double positive_modulus(const char* name, double value) {
  if (std::isfinite(value) && value > 0) return value;
  throw std::invalid_argument(std::string("stiffness ") + name + " is " + std::to_string(value) +
                              "; expected a positive number of kPa");
}

}  // namespace mammotwin
