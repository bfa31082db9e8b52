// One reader (MAMMOTWIN_READER) as libFuzzer's target. What the reader refuses in words is as it
// should be; words for programmers count as a crash, and so does what no handler catches.

#include <cstdio>
#include <cstdlib>
#include <exception>
#include <new>

#include "tests/fuzz/mutations.h"
#include "tests/fuzz/readers/reader.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mammotwin;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  try {
    fuzz::MAMMOTWIN_READER(bytes);
  } catch (const std::bad_alloc&) {
    std::fputs("memory was asked for that is not there\n", stderr);
    std::abort();
  } catch (const std::exception& refused) {
    if (is_said_to_a_user(refused.what(), bytes)) return 0;
    std::fprintf(stderr, "a user would be told: %s\n", refused.what());
    std::abort();
  }
  return 0;
}

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size,
                                               std::size_t most, unsigned seed) {
  return mammotwin::mutate({reinterpret_cast<char*>(data), size}, data, most, seed);
}
