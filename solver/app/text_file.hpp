// Small text files read whole, with limits, so that a wrong file name costs a message and not a minute.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace hawser {

struct FileTrouble {
  std::string reason;  // "is a directory"
};

/// The whole text of a regular file of at most `limit` bytes without zero bytes; else why not.
std::variant<std::string, FileTrouble> read_text_file(const std::string& path, std::size_t limit);

/// Lines of a text without their ends ("\n" or "\r\n"). Views into `text`.
std::vector<std::string_view> split_lines(std::string_view text);

/// `file` relative to the folder of `beside`, or `file` itself where it is absolute.
std::string path_beside(const std::string& beside, const std::string& file);

/// A window of at most 160 characters of a line around `column` (1-based, characters), and the column within it.
struct Excerpt {
  std::string text;
  int column;
};
Excerpt excerpt(std::string_view line, int column);

}  // namespace hawser
