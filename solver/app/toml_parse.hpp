// Parsing with toml++, the only place that includes it, made safe for text from a user.
//
// toml++ 3.3 asserts about malformed text what its following lines report as an ordinary error ("[ *"), frees tables
// recursively, one level a part of a dotted key, so that a long key exhausts the stack, and takes characters from U+00A1
// on outside of strings for an impossible case (undefined behaviour). Assertions are therefore off, and text with such
// keys or characters is refused before toml++ sees it.
#pragma once

#define TOML_ASSERT(expression) static_assert(true)
#include <toml++/toml.h>

#include <string>
#include <string_view>

namespace hawser {

/// The table of a TOML text; `source` is the name kept with every value. Throws toml::parse_error.
toml::table parse_toml(std::string_view text, const std::string& source);

}  // namespace hawser
