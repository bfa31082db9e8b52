#include "registration/export/burned_words.h"

#include <algorithm>
#include <array>
#include <map>
#include <stdexcept>

namespace mammotwin {
namespace {

constexpr int kLetterRows = 7, kLetterColumns = 5, kLetterPitch = 6;  // squares

using Letter = std::array<const char*, kLetterRows>;
const std::map<char, Letter> kLetters = {
    {'A', {" ### ", "#   #", "#   #", "#####", "#   #", "#   #", "#   #"}},
    {'D', {"#### ", "#   #", "#   #", "#   #", "#   #", "#   #", "#### "}},
    {'E', {"#####", "#    ", "#    ", "#### ", "#    ", "#    ", "#####"}},
    {'I', {"#####", "  #  ", "  #  ", "  #  ", "  #  ", "  #  ", "#####"}},
    {'L', {"#    ", "#    ", "#    ", "#    ", "#    ", "#    ", "#####"}},
    {'M', {"#   #", "## ##", "# # #", "#   #", "#   #", "#   #", "#   #"}},
    {'S', {" ####", "#    ", "#    ", " ### ", "    #", "    #", "#### "}},
    {'T', {"#####", "  #  ", "  #  ", "  #  ", "  #  ", "  #  ", "  #  "}},
    {'U', {"#   #", "#   #", "#   #", "#   #", "#   #", "#   #", " ### "}}};

const Letter& letter_of(char c) {
  const auto found = kLetters.find(c);
  if (found == kLetters.end())
    throw std::invalid_argument(std::string("no letter is drawn for '") + c + "'");
  return found->second;
}

}  // namespace

GreyPixels with_words(const GreyPixels& picture, const std::string& words) {
  const int width = kLetterPitch * static_cast<int>(words.size()) + 1;
  if (picture.columns < width)
    throw std::invalid_argument("a picture of " + std::to_string(picture.columns) +
                                " columns is too narrow for \"" + words + "\"");
  const int square = std::max(1, picture.columns / (2 * width));
  const int band = (kLetterRows + 2) * square;
  GreyPixels whole{picture.columns, picture.rows + band, {}};
  whole.grey.assign(static_cast<std::size_t>(band) * picture.columns, 0);
  whole.grey.insert(whole.grey.end(), picture.grey.begin(), picture.grey.end());
  for (int row = 0; row < kLetterRows * square; ++row)
    for (int column = 0; column < (width - 1) * square; ++column) {
      const int in_letter = column / square % kLetterPitch;
      if (in_letter >= kLetterColumns) continue;
      const Letter& letter = letter_of(words[column / square / kLetterPitch]);
      if (letter[row / square][in_letter] != '#') continue;
      whole.grey[static_cast<std::size_t>(row + square) * picture.columns + column + square] =
          65535;
    }
  return whole;
}

}  // namespace mammotwin
