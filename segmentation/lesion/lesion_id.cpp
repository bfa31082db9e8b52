#include "segmentation/lesion/lesion_id.h"

namespace mammotwin {

std::string fault_of_lesion_id(const std::string& id) {
  constexpr std::size_t most_bytes = 64;  // more has no place in a table or a file's label
  if (id.size() > most_bytes) return "is longer than 64 bytes";
  for (const unsigned char c : id)
    if (c < ' ' || c == 127) return "holds a control character (a newline, a tab)";
  for (const char* mark : {"\u200e", "\u200f", "\u202a", "\u202b", "\u202c", "\u202d", "\u202e",
                           "\u2066", "\u2067", "\u2068", "\u2069", "\u061c"})
    if (id.find(mark) != std::string::npos) return "holds a mark that turns the text's direction";
  for (const char* end : {"\u0085", "\u2028", "\u2029"})
    if (id.find(end) != std::string::npos) return "holds the end of a line";
  if (id.find('\\') != std::string::npos)
    return "holds a backslash, which separates values in DICOM";
  if (!id.empty() && std::string("=+-@").find(id.front()) != std::string::npos)
    return "begins with a character that makes it a formula in a spreadsheet";
  return "";
}

}  // namespace mammotwin
