#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

namespace mammotwin {

/// page.html filled with the data of `page_data`, with style and scripts inside.
std::string render_page(const nlohmann::json& page);

}  // namespace mammotwin
