#pragma once

#include <functional>
#include <string>

namespace mammotwin {

using Progress = std::function<void(double fraction, const std::string& what)>;

}  // namespace mammotwin
