#include "pipeline/frame/sentence.h"

#include <gtest/gtest.h>

namespace mammotwin {
namespace {

TEST(Sentence, HoldsItsNumbersHoweverLongItIs) {
  EXPECT_EQ(sentence("%.1f of %d %s, %.0f %%", 0.25, 3, "mm", 12.0), "0.2 of 3 mm, 12 %");
  const std::string word(1000, 'a');
  EXPECT_EQ(sentence("%s%s", word.c_str(), word.c_str()), word + word);
}

}  // namespace
}  // namespace mammotwin
