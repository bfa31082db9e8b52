#pragma once

#include <string>

#include "pipeline/report/picture.h"

namespace mammotwin {

/// A picture with the words that stand for it where it cannot be seen.
struct Figure {
  Picture picture;
  std::string caption;
  std::string alt;
};

}  // namespace mammotwin
