#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>

namespace mammotwin {

/// The lines "Name = value" of a MetaImage header, up to ElementDataFile.
struct MetaHeader {
  std::map<std::string, std::string> fields;
  std::uintmax_t bytes = 0;  ///< of the header, where the voxels begin if they lie behind it

  std::string field(const std::string& name) const;  ///< empty where it is not there
};

/// Looks through a MetaImage header before the library does: MetaIO 5.2 copies each field into 255
/// bytes unasked, goes on without an end where NDims is negative, and a damaged header ends the
/// program. Throws std::runtime_error, without the path, where a line up to ElementDataFile is no
/// "Name = value" of printable characters, is too long, ElementDataFile does not come, or NDims and
/// DimSize are no counts.
MetaHeader read_meta_header(const std::filesystem::path& path);

/// MetaIO takes a file that ends early for whole. Throws std::runtime_error, without the path,
/// where fewer than `expected` bytes of voxels are there, unpacked where they are packed.
void check_meta_voxels(const std::filesystem::path& path, const MetaHeader& header,
                       std::uintmax_t expected);

}  // namespace mammotwin
