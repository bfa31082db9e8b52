#include "tests/fuzz/mutations.h"

#include <zlib.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cstring>
#include <optional>
#include <random>
#include <vector>

extern "C" std::size_t LLVMFuzzerMutate(std::uint8_t* data, std::size_t size, std::size_t most);

namespace mammotwin {
namespace {

using Random = std::minstd_rand;
using Change = std::optional<std::string>;  // empty where the input has no place for it

std::size_t below(std::size_t limit, Random& random) { return random() % limit; }

std::string changed_bytes(std::string bytes, std::size_t growth) {
  const std::size_t size = bytes.size();
  bytes.resize(size + growth);
  bytes.resize(LLVMFuzzerMutate(reinterpret_cast<std::uint8_t*>(bytes.data()), size, bytes.size()));
  return bytes;
}

/// Another number where a run of digits stands.
Change with_another_number(const std::string& text, Random& random) {
  constexpr std::array odd{"0",          "-1",          "1",
                           "2",          "65536",       "2147483647",
                           "2147483648", "-2147483648", "99999999999999999999",
                           "1e308",      "-1e-308",     "nan",
                           "inf",        "0.5",         "256"};
  const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
  std::vector<std::size_t> begins;
  for (std::size_t i = 0; i < text.size(); ++i)
    if (digit(text[i]) && (i == 0 || !digit(text[i - 1]))) begins.push_back(i);
  if (begins.empty()) return {};
  const std::size_t begin = begins[below(begins.size(), random)];
  std::size_t end = begin;
  while (end < text.size() && digit(text[end])) ++end;
  return text.substr(0, begin) + odd[below(odd.size(), random)] + text.substr(end);
}

/// A line left out or doubled.
Change with_another_line(const std::string& text, Random& random) {
  std::vector<std::size_t> begins{0};
  for (std::size_t i = 0; i + 1 < text.size(); ++i)
    if (text[i] == '\n') begins.push_back(i + 1);
  if (begins.size() < 2) return {};
  const std::size_t n = below(begins.size(), random), begin = begins[n];
  const std::size_t end = n + 1 < begins.size() ? begins[n + 1] : text.size();
  const std::string line = random() % 2 ? text.substr(begin, end - begin) : std::string();
  return text.substr(0, begin) + line + line + text.substr(end);
}

Change inflated(const std::string& packed, std::size_t begin, int window, std::size_t& used) {
  constexpr std::size_t most = 1 << 20;
  z_stream z{};
  if (inflateInit2(&z, window) != Z_OK) return {};
  std::string bytes(most, '\0');
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data() + begin));
  z.avail_in = static_cast<uInt>(packed.size() - begin);
  z.next_out = reinterpret_cast<Bytef*>(bytes.data());
  z.avail_out = static_cast<uInt>(bytes.size());
  const int end = inflate(&z, Z_FINISH);
  bytes.resize(z.total_out);
  used = z.total_in;
  inflateEnd(&z);
  return end == Z_STREAM_END ? Change(bytes) : Change();
}

std::string deflated(const std::string& bytes, int window) {
  z_stream z{};
  deflateInit2(&z, 1, Z_DEFLATED, window, 8, Z_DEFAULT_STRATEGY);
  std::string packed(deflateBound(&z, bytes.size()) + 64, '\0');
  z.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(bytes.data()));
  z.avail_in = static_cast<uInt>(bytes.size());
  z.next_out = reinterpret_cast<Bytef*>(packed.data());
  z.avail_out = static_cast<uInt>(packed.size());
  deflate(&z, Z_FINISH);
  packed.resize(z.total_out);
  deflateEnd(&z);
  return packed;
}

constexpr int kGzipWindow = 31, kZlibWindow = 15;

/// The first gzip member, also behind a text header.
Change inside_gzip(const std::string& bytes, Random&) {
  const std::size_t begin = bytes.find("\x1f\x8b\x08");
  std::size_t used = 0;
  if (begin == std::string::npos) return {};
  const Change inner = inflated(bytes, begin, kGzipWindow, used);
  if (!inner) return {};
  return bytes.substr(0, begin) + deflated(changed_bytes(*inner, 64), kGzipWindow) +
         bytes.substr(begin + used);
}

const std::string kBase64 = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";

std::string from_base64(const std::string& text) {
  std::string bytes;
  std::uint32_t bits = 0;
  int count = 0;
  for (const char c : text) {
    const std::size_t value = kBase64.find(c);
    if (value == std::string::npos) continue;
    bits = bits << 6 | static_cast<std::uint32_t>(value);
    if ((count += 6) < 8) continue;
    bytes += static_cast<char>(bits >> (count -= 8));
  }
  return bytes;
}

std::string to_base64(const std::string& bytes) {
  std::string text;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t bits = 0;
    const std::size_t n = std::min<std::size_t>(3, bytes.size() - i);
    for (std::size_t k = 0; k < 3; ++k)
      bits = bits << 8 | (k < n ? static_cast<unsigned char>(bytes[i + k]) : 0);
    for (std::size_t k = 0; k < 4; ++k) text += k <= n ? kBase64[bits >> (18 - 6 * k) & 63] : '=';
  }
  return text;
}

/// VTK's inline array of one compressed block: base64 of four 32-bit counts (blocks, their size,
/// the last one's, the packed size), then base64 of a zlib stream.
Change inside_array(const std::string& text, Random& random) {
  constexpr std::size_t header_digits = 24;  // 16 bytes in base64
  std::vector<std::size_t> begins;
  for (std::size_t at = 0; (at = text.find("format=\"binary\"", at)) != std::string::npos; ++at)
    begins.push_back(at);
  if (begins.empty()) return {};
  const std::size_t tag_end = text.find('>', begins[below(begins.size(), random)]);
  const std::size_t begin = text.find_first_not_of(" \n", tag_end + 1);
  const std::size_t end = text.find_first_of(" \n<", begin);
  if (tag_end == std::string::npos || end == std::string::npos || end < begin + header_digits)
    return {};
  std::size_t used = 0;
  const Change inner =
      inflated(from_base64(text.substr(begin + header_digits, end - begin - header_digits)), 0,
               kZlibWindow, used);
  if (!inner) return {};
  const std::string bytes = changed_bytes(*inner, 64), packed = deflated(bytes, kZlibWindow);
  const std::uint32_t counts[] = {1, static_cast<std::uint32_t>(bytes.size()), 0,
                                  static_cast<std::uint32_t>(packed.size())};
  return text.substr(0, begin) + to_base64({reinterpret_cast<const char*>(counts), sizeof counts}) +
         to_base64(packed) + text.substr(end);
}

}  // namespace

std::size_t mutate(const std::string& input, std::uint8_t* out, std::size_t most, unsigned seed) {
  Random random(seed + 1);
  constexpr std::array changes{with_another_number, with_another_line, inside_gzip, inside_array};
  if (random() % 3 != 0)
    for (std::size_t tries = 0; tries < changes.size(); ++tries)
      if (const Change changed = changes[below(changes.size(), random)](input, random);
          changed && changed->size() <= most) {
        std::memcpy(out, changed->data(), changed->size());
        return changed->size();
      }
  std::memmove(out, input.data(), input.size());
  return LLVMFuzzerMutate(out, input.size(), most);
}

}  // namespace mammotwin
