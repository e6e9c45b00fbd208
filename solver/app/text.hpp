// Text for people: numbers with units, clocks, tables, and the choice between a terminal and a file.
#pragma once

#include <cstdio>
#include <string>
#include <string_view>
#include <vector>

namespace hawser {

/// Three significant digits with an SI prefix: 58200, "N" -> "58.2 kN". Prefixes from m to G; 0 -> "0 N".
std::string with_prefix(double value, std::string_view unit);

/// 65 -> "01:05", 3661 -> "1:01:01"; "--:--" where the value is not finite or negative.
std::string clock_text(double seconds);

/// Shortest text that reads back as the same double and shows that it is one: 50 -> "50.0", 93.1 -> "93.1".
std::string decimal_text(double value);

/// Columns aligned with two blanks between them: the first to the left, the others to the right. One line a row.
std::string table(const std::vector<std::vector<std::string>>& rows);

bool is_terminal(std::FILE* stream);

/// `text` in an ANSI colour (31 red, 33 yellow, 32 green) where the stream is a terminal and NO_COLOR is not set; else `text`.
std::string painted(std::FILE* stream, int colour, std::string_view text);

/// "error: ..." and "warning: ..." on stderr.
void say_error(std::string_view text);
void say_warning(std::string_view text);

}  // namespace hawser
