#pragma once

#include <map>
#include <string>
#include <vector>

namespace mammotwin {

/// The bytes, and what every compressed or coded stream in them holds: gzip members, zlib streams
/// and runs of base64 (of 40 digits and more), wherever they begin, and streams inside those.
struct OpenedStreams {
  std::vector<std::string> texts;
  std::map<std::string, int> opened;  ///< "gzip", "zlib", "base64" -> how many
};
OpenedStreams opened_streams(const std::string& bytes);

}  // namespace mammotwin
