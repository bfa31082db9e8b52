#pragma once

#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

namespace mammotwin {

/// A NIfTI-1 header of a float volume; RAS affine diag(-1, -1, 1) is LPS with identity axes.
inline std::string nifti_header(int nx, int ny, int nz) {
  std::string h(352, '\0');
  const auto put = [&](std::size_t at, auto value) { std::memcpy(&h[at], &value, sizeof value); };
  put(0, std::int32_t{348});
  const std::int16_t dims[8] = {3, std::int16_t(nx), std::int16_t(ny), std::int16_t(nz), 1, 1, 1,
                                1};
  std::memcpy(&h[40], dims, sizeof dims);
  put(70, std::int16_t{16});  // float
  put(72, std::int16_t{32});
  const float pixdim[8] = {1, 1, 1, 2, 1, 1, 1, 1};
  std::memcpy(&h[76], pixdim, sizeof pixdim);
  put(108, 352.0F);
  put(112, 1.0F);
  h[123] = 2;                 // mm
  put(254, std::int16_t{1});  // sform
  const float rows[12] = {-1, 0, 0, 10, 0, -1, 0, 20, 0, 0, 2, 30};
  std::memcpy(&h[280], rows, sizeof rows);
  std::memcpy(&h[344], "n+1", 4);
  return h;
}

inline std::filesystem::path write_nifti(const std::filesystem::path& path, int nx, int ny, int nz,
                                         std::vector<float> values) {
  std::ofstream file(path, std::ios::binary);
  file << nifti_header(nx, ny, nz);
  file.write(reinterpret_cast<const char*>(values.data()),
             static_cast<std::streamsize>(values.size() * sizeof(float)));
  return path;
}

inline std::vector<float> counting(std::size_t n) {
  std::vector<float> values(n);
  for (std::size_t i = 0; i < n; ++i) values[i] = static_cast<float>(i);
  return values;
}

}  // namespace mammotwin
