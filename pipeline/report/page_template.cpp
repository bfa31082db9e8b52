#include "pipeline/report/page_template.h"

#include <kainjow/mustache.hpp>
#include <nlohmann/json.hpp>
#include <stdexcept>

// Laid into the program by the linker: see embed_files in CMakeLists.txt.
#define MAMMOTWIN_EMBEDDED(name)              \
  extern const char _binary_##name##_start[]; \
  extern const char _binary_##name##_end[];
extern "C" {
MAMMOTWIN_EMBEDDED(page_html)
MAMMOTWIN_EMBEDDED(page_css)
MAMMOTWIN_EMBEDDED(page_js)
MAMMOTWIN_EMBEDDED(planes_js)
MAMMOTWIN_EMBEDDED(view_panes_js)
MAMMOTWIN_EMBEDDED(carry_js)
MAMMOTWIN_EMBEDDED(what_if_js)
MAMMOTWIN_EMBEDDED(viewer_js)
MAMMOTWIN_EMBEDDED(three_min_js)
MAMMOTWIN_EMBEDDED(OrbitControls_js)
}
#undef MAMMOTWIN_EMBEDDED
#define MAMMOTWIN_TEXT(name) std::string(_binary_##name##_start, _binary_##name##_end)

namespace mammotwin {
namespace {

namespace mustache = kainjow::mustache;

mustache::data mustache_data(const nlohmann::json& value) {
  if (value.is_object()) {
    mustache::data object{mustache::data::type::object};
    for (const auto& [key, child] : value.items()) object.set(key, mustache_data(child));
    return object;
  }
  if (value.is_array()) {
    mustache::data list{mustache::data::type::list};
    for (const nlohmann::json& child : value) list.push_back(mustache_data(child));
    return list;
  }
  if (value.is_boolean())
    return mustache::data{value.get<bool>() ? mustache::data::type::bool_true
                                            : mustache::data::type::bool_false};
  if (value == "")
    return mustache::data{mustache::data::type::bool_false};  // its section is left out
  return mustache::data{value.is_string() ? value.get<std::string>() : value.dump()};
}

/// A script element ends at the first "</": inside a JSON string "<\/" means the same.
std::string inside_script(std::string json) {
  for (std::size_t i = 0; (i = json.find("</", i)) != std::string::npos; i += 3)
    json.replace(i, 2, "<\\/");
  return json;
}

}  // namespace

std::string render_page(const nlohmann::json& page) {
  mustache::data data = mustache_data(page);
  data.set("css", MAMMOTWIN_TEXT(page_css));
  data.set("page_js", MAMMOTWIN_TEXT(page_js));
  if (page.contains("volume")) {
    data.set("volume", inside_script(page["volume"].get<std::string>()));
    data.set("planes_js", MAMMOTWIN_TEXT(planes_js));
  }
  if (page.contains("views")) {
    data.set("views", inside_script(page["views"].get<std::string>()));
    data.set("carry", inside_script(page["carry"].get<std::string>()));
    data.set("view_panes_js", MAMMOTWIN_TEXT(view_panes_js));
    data.set("carry_js", MAMMOTWIN_TEXT(carry_js));
    data.set("what_if_js", MAMMOTWIN_TEXT(what_if_js));
  }
  if (page.contains("scene")) {
    data.set("scene", inside_script(page["scene"].get<std::string>()));
    data.set("three_js", MAMMOTWIN_TEXT(three_min_js));
    data.set("orbit_js", MAMMOTWIN_TEXT(OrbitControls_js));
    data.set("viewer_js", MAMMOTWIN_TEXT(viewer_js));
  }
  mustache::mustache page_template(MAMMOTWIN_TEXT(page_html));
  if (!page_template.is_valid())
    throw std::logic_error("page.html: " + page_template.error_message());
  return page_template.render(data);
}

}  // namespace mammotwin
