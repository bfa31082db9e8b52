#pragma once

#include "pipeline/report/picture.h"

#include <string>

namespace mammotwin {

/// A picture with the words that stand for it where it cannot be seen.
struct Figure {
  Picture picture;
  std::string caption;
  std::string alt;
};

}  // namespace mammotwin
