#include "fitting/mesh/check_vtu.h"

#include <vtkBase64Utilities.h>
#include <vtkCallbackCommand.h>
#include <vtkNew.h>
#include <vtkXMLDataElement.h>
#include <vtkXMLDataParser.h>
#include <vtkZLibDataCompressor.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <set>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace mammotwin {
namespace {

/// deflate packs at most 1032 bytes in one (zlib.net/zlib_tech.html); one byte a value at least.
constexpr double kMostPacked = 1032;

/// Base64 text up to white space or a tag, at most `digits` of it.
std::vector<unsigned char> decoded(std::string_view text, std::size_t digits) {
  text = text.substr(0, std::min(text.find_first_of(" \t\r\n<"), digits));
  std::vector<unsigned char> bytes(text.size() / 4 * 3 + 3);
  bytes.resize(vtkBase64Utilities::DecodeSafely(reinterpret_cast<const unsigned char*>(text.data()),
                                                text.size(), bytes.data(), bytes.size()));
  return bytes;
}

/// The first `count` numbers of `size` bytes of base64 text; fewer where it ends.
std::vector<std::uint64_t> first_numbers(std::string_view text, std::size_t count,
                                         std::size_t size) {
  const std::vector<unsigned char> bytes = decoded(text, (count * size + 2) / 3 * 4);
  std::vector<std::uint64_t> numbers(std::min(count, bytes.size() / size));
  for (std::size_t n = 0; n < numbers.size(); ++n)
    std::memcpy(&numbers[n], bytes.data() + n * size, size);  // little endian, as it is written
  return numbers;
}

class VtuTree {
 public:
  VtuTree(const std::filesystem::path& path, std::string text, vtkXMLDataElement* root)
      : path_(path),
        text_(std::move(text)),
        root_(root),
        bytes_(static_cast<double>(text_.size())) {
    const char* words = root->GetAttribute("header_type");
    word_ = words && std::string(words) == "UInt64" ? 8 : 4;
    packed_ = root->GetAttribute("compressor") != nullptr;
  }

  void check() const { check(root_, 1); }

 private:
  /// `values`: how many the element around it asks for, an array's components not counted
  void check(vtkXMLDataElement* element, double values) const {
    for (const char* count : {"NumberOfPoints", "NumberOfCells", "NumberOfTuples"})
      values = std::max(values, count_of(element, count));
    if (is_array(element)) {
      check_type(element);
      if (values * count_of(element, "NumberOfComponents") > most())
        refuse(element, "asks for more values than the file can hold");
      const char* format = element->GetAttribute("format");
      check_lengths(element, format ? format : "without a format");
      const char* name = element->GetAttribute("Name");
      if (name && std::string(name) == "offsets") check_offsets(element);
    }
    std::set<std::string> known;
    for (int n = 0; n < element->GetNumberOfNestedElements(); ++n) {
      vtkXMLDataElement* inner = element->GetNestedElement(n);
      const char* array = inner->GetAttribute("Name");
      if (array && !known.insert(array).second)
        throw std::runtime_error(path_.string() + ": array " + array +
                                 " is there twice; expected it once: make the file again");
      check(inner, values);
    }
  }

  double most() const { return kMostPacked * bytes_; }

  /// Whole, not negative, and no more than the file can hold; 0 where the element does not say it.
  double count_of(vtkXMLDataElement* element, const char* name) const {
    const char* text = element->GetAttribute(name);
    if (!text) return 0;
    char* end = nullptr;
    const double count = std::strtod(text, &end);
    if (*text != '\0' && *end == '\0' && count >= 0 && count <= most()) return count;
    throw std::runtime_error(path_.string() + ": " + name + " is \"" + text + "\"; expected 0 to " +
                             std::to_string(static_cast<long long>(most())) +
                             ", which is what a file of this size can hold: make the file again");
  }

  static bool is_array(vtkXMLDataElement* element) {
    const std::string kind = element->GetName();
    return kind == "DataArray" || kind == "Array" || element->GetAttribute("format");
  }

  void check_type(vtkXMLDataElement* element) const {
    static const std::set<std::string> known{"Int8",    "UInt8",   "Int16", "UInt16",
                                             "Int32",   "UInt32",  "Int64", "UInt64",
                                             "Float32", "Float64", "String"};
    const char* type = element->GetAttribute("type");
    if (!type || !known.contains(type))
      refuse(element, std::string("is of type \"") + (type ? type : "") +
                          "\"; expected integers or floats of 8 to 64 bits");
  }

  /// Before its values an array says how long they are: packed, the number of blocks, the length
  /// of a block, that of the last one and of each of them packed; else their length.
  void check_lengths(vtkXMLDataElement* element, const std::string& format) const {
    if (format == "ascii") return;
    if (format != "binary")
      refuse(element, "is " + format + "; expected values in place (data mode binary)");
    const std::string_view text = text_of(element);
    const auto begin = first_numbers(text, packed_ ? 3 : 1, word_);
    if (!packed_) {
      if (begin.size() < 1 || static_cast<double>(begin[0]) > bytes_) refuse_lengths(element);
      return;
    }
    if (begin.size() < 3 || static_cast<double>(begin[0]) * static_cast<double>(word_) > bytes_)
      refuse_lengths(element);
    const auto all = first_numbers(text, 3 + begin[0], word_);
    double packed = 0;
    for (std::size_t n = 3; n < all.size(); ++n) packed += static_cast<double>(all[n]);
    const double longest = most() + kLeastBlock;
    if (all.size() < 3 + begin[0] || packed > bytes_ || static_cast<double>(all[1]) > longest ||
        static_cast<double>(all[2]) > longest)
      refuse_lengths(element);
  }

  /// VTK makes room for as many points of cells as the last offset says.
  void check_offsets(vtkXMLDataElement* element) const {
    const std::string type = element->GetAttribute("type");
    const std::size_t size = type.ends_with("64") ? 8 : 4;
    const std::vector<unsigned char> bytes = values_of(element);
    for (std::size_t at = 0; at + size <= bytes.size(); at += size) {
      std::int64_t offset = 0;
      std::memcpy(&offset, bytes.data() + at, size);
      if (offset < 0 || static_cast<double>(offset) > most())
        refuse(element, "holds " + std::to_string(offset) + ", beyond what the file can hold");
    }
  }

  /// The bytes of an array that `check_lengths` has accepted; fewer where it is damaged.
  std::vector<unsigned char> values_of(vtkXMLDataElement* element) const {
    const std::string_view text = text_of(element);
    const auto begin = first_numbers(text, packed_ ? 3 : 1, word_);
    const std::size_t header = packed_ ? 3 + begin[0] : 1;
    const auto lengths = first_numbers(text, header, word_);
    const std::vector<unsigned char> packed =
        decoded(text.substr(std::min(text.size(), (header * word_ + 2) / 3 * 4)), text.size());
    if (!packed_) return packed;
    std::vector<unsigned char> values;
    vtkNew<vtkZLibDataCompressor> zlib;
    std::size_t at = 0;
    for (std::size_t n = 3; n < lengths.size() && at + lengths[n] <= packed.size(); ++n) {
      const bool last = n + 1 == lengths.size() && lengths[2] > 0;
      std::vector<unsigned char> block(lengths[last ? 2 : 1]);
      block.resize(zlib->Uncompress(packed.data() + at, lengths[n], block.data(), block.size()));
      values.insert(values.end(), block.begin(), block.end());
      at += lengths[n];
    }
    return values;
  }

  /// What stands behind its tag, white space left out.
  std::string_view text_of(vtkXMLDataElement* element) const {
    const std::string_view all = text_;
    const std::size_t tag_ends =
        all.find('>', static_cast<std::size_t>(element->GetXMLByteIndex()));
    const std::size_t begin = all.find_first_not_of(" \t\r\n>", tag_ends);
    return begin == std::string_view::npos ? std::string_view() : all.substr(begin);
  }

  [[noreturn]] void refuse_lengths(vtkXMLDataElement* element) const {
    refuse(element, "says to be longer than the file; expected a whole file");
  }

  [[noreturn]] void refuse(vtkXMLDataElement* element, const std::string& what) const {
    const char* name = element->GetAttribute("Name");
    throw std::runtime_error(path_.string() + ": array " + (name ? name : "without a name") + ' ' +
                             what + ": make the file again");
  }

  static constexpr double kLeastBlock = 1 << 20;  // VTK's default is 32 kB, however few the values
  const std::filesystem::path& path_;
  std::string text_;
  vtkXMLDataElement* root_;
  double bytes_;
  std::size_t word_ = 4;
  bool packed_ = false;
};

}  // namespace

void check_vtu(const std::filesystem::path& path) {
  vtkNew<vtkCallbackCommand> quiet;
  quiet->SetCallback([](vtkObject*, unsigned long, void*, void*) {});
  vtkNew<vtkXMLDataParser> parser;
  parser->AddObserver("ErrorEvent", quiet);
  parser->SetIgnoreCharacterData(1);
  parser->SetFileName(path.c_str());
  if (!parser->Parse() || !parser->GetRootElement())
    throw std::runtime_error(path.string() +
                             ": is not a whole .vtu file (truncated or of another format); "
                             "make it again");
  std::ifstream in(path, std::ios::binary);
  VtuTree(path, {std::istreambuf_iterator<char>(in), {}}, parser->GetRootElement()).check();
}

}  // namespace mammotwin
