#include "tests/pipeline/opened_streams.h"

#include <zlib.h>

#include <cctype>
#include <cstdint>

namespace mammotwin {
namespace {

/// What a stream that begins here unpacks to, as far as it goes; empty where none begins.
std::string inflated(const std::string& bytes, std::size_t begin) {
  constexpr int zlib_or_gzip = 15 + 32;
  constexpr std::size_t piece = 1 << 20;
  z_stream z{};
  if (inflateInit2(&z, zlib_or_gzip) != Z_OK) return {};
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data() + begin));
  z.avail_in = static_cast<uInt>(bytes.size() - begin);
  std::string out;
  for (int state = Z_OK; state == Z_OK;) {
    out.resize(z.total_out + piece);
    z.next_out = reinterpret_cast<Bytef*>(out.data() + z.total_out);
    z.avail_out = piece;
    state = inflate(&z, Z_NO_FLUSH);
  }
  out.resize(z.total_out);
  inflateEnd(&z);
  return out;
}

bool is_digit(char c) {
  return std::isalnum(static_cast<unsigned char>(c)) || c == '+' || c == '/';
}

int value_of(char c) {
  if (c >= 'A' && c <= 'Z') return c - 'A';
  if (c >= 'a' && c <= 'z') return c - 'a' + 26;
  if (c >= '0' && c <= '9') return c - '0' + 52;
  return c == '+' ? 62 : 63;
}

std::string decoded(const std::string& bytes, std::size_t begin, std::size_t end) {
  std::string out;
  std::uint32_t bits = 0;
  int count = 0;
  for (std::size_t i = begin; i < end; ++i) {
    bits = bits << 6 | static_cast<std::uint32_t>(value_of(bytes[i]));
    if ((count += 6) >= 8) out += static_cast<char>(bits >> (count -= 8));
  }
  return out;
}

/// A stream's first bytes: gzip's, or zlib's whose first two are a multiple of 31 (RFC 1950).
const char* kind_at(const std::string& bytes, std::size_t at) {
  const auto first = static_cast<unsigned char>(bytes[at]);
  const auto second = static_cast<unsigned char>(bytes[at + 1]);
  if (first == 0x1f && second == 0x8b) return "gzip";
  return first == 0x78 && (first * 256 + second) % 31 == 0 ? "zlib" : nullptr;
}

void open_into(const std::string& bytes, int depth, OpenedStreams& all) {
  all.texts.push_back(bytes);
  if (depth == 0) return;
  for (std::size_t at = 0; at + 1 < bytes.size(); ++at)
    if (const char* kind = kind_at(bytes, at))
      if (const std::string inner = inflated(bytes, at); inner.size() > 16) {
        ++all.opened[kind];
        open_into(inner, depth - 1, all);
      }
  constexpr std::size_t shortest = 40;
  for (std::size_t at = 0; at < bytes.size(); ++at) {
    std::size_t end = at;
    while (end < bytes.size() && is_digit(bytes[end])) ++end;
    if (end - at >= shortest) {
      ++all.opened["base64"];
      open_into(decoded(bytes, at, end), depth - 1, all);
    }
    at = end;
  }
}

}  // namespace

OpenedStreams opened_streams(const std::string& bytes) {
  constexpr int depth = 3;
  OpenedStreams all;
  open_into(bytes, depth, all);
  return all;
}

}  // namespace mammotwin
