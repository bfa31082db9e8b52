#pragma once

#include <string>

#include "registration/export/png_file.h"

namespace mammotwin {

/// The picture below a black band with `words` in white, in letters of 5 x 7 squares that are as
/// large as fit into half of the width. Throws std::invalid_argument for a letter that is not one
/// of "ADEILMSTU", and for a picture too narrow for the words.
GreyPixels with_words(const GreyPixels& picture, const std::string& words);

}  // namespace mammotwin
