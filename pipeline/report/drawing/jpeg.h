#pragma once

#include <cstdint>
#include <functional>
#include <string>

namespace mammotwin {

/// A grey picture as JPEG; `fill_row` writes a row's `columns` values.
std::string grey_jpeg(int columns, int rows,
                      const std::function<void(int row, std::uint8_t* values)>& fill_row);

}  // namespace mammotwin
