#pragma once

#include <string>

namespace mammotwin {

std::string base64(const void* data, std::size_t bytes);

/// "data:<type>;base64,..." for an attribute that holds a picture.
std::string data_uri(const std::string& media_type, const std::string& content);

}  // namespace mammotwin
