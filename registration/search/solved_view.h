#pragma once

#include "registration/view/compressed_view.h"
#include "solver/press/compression_result.h"

namespace mammotwin {

/// A compression with the view's frame that its plates make.
struct SolvedView {
  CompressionResult result;
  CompressedView view;
};

}  // namespace mammotwin
