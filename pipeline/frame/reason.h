#pragma once

#include <exception>
#include <string>

namespace mammotwin {

/// True where memory, or a thread, was asked for and is not there.
bool lacks_memory(const std::exception& error);

/// What a user is told of an error: its own words where they are a sentence of this program, and
/// else, as of a library's "vector::_M_default_append", what to do about data that nobody foresaw.
std::string reason_of(const std::exception& error);

}  // namespace mammotwin
