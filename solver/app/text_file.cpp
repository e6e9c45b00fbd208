#include "solver/app/text_file.hpp"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

namespace hawser {

namespace fs = std::filesystem;

namespace {

bool inside_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

/// Bytes before the character with this number (0-based), at most the size.
std::size_t byte_of(std::string_view line, std::size_t character) {
  std::size_t at = 0;
  for (; at < line.size(); ++at) {
    if (inside_character(line[at])) continue;
    if (character-- == 0) break;
  }
  return at;
}

}  // namespace

std::variant<std::string, FileTrouble> read_text_file(const std::string& path, std::size_t limit) {
  std::error_code failure;
  const fs::file_status status = fs::status(path, failure);
  if (!fs::exists(status)) return FileTrouble{failure && failure != std::errc::no_such_file_or_directory ? failure.message() : "does not exist"};
  if (fs::is_directory(status)) return FileTrouble{"is a directory"};
  if (!fs::is_regular_file(status)) return FileTrouble{"is not a regular file"};
  const std::uintmax_t size = fs::file_size(path, failure);
  if (failure) return FileTrouble{failure.message()};
  if (size > limit) return FileTrouble{fmt::format("is too large: {} bytes, at most {} are read", size, limit)};
  std::ifstream stream(path, std::ios::binary);
  if (!stream) return FileTrouble{fmt::format("cannot be opened: {}", std::strerror(errno))};
  std::string text(size, '\0');
  stream.read(text.data(), static_cast<std::streamsize>(size));
  text.resize(static_cast<std::size_t>(stream.gcount()));
  if (stream.bad()) return FileTrouble{"cannot be read"};
  if (text.find('\0') != std::string::npos) return FileTrouble{"is a binary file, not text"};
  return text;
}

std::vector<std::string_view> split_lines(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    std::string_view line = text.substr(0, end);
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines.push_back(line);
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return lines;
}

std::string path_beside(const std::string& beside, const std::string& file) { return (fs::path(beside).parent_path() / file).string(); }

Excerpt excerpt(std::string_view line, int column) {
  constexpr int before = 60, whole = 160;
  const bool fits = byte_of(line, whole) == line.size();
  const int skipped = !fits && column > whole - before ? column - before : 0;
  const std::size_t begin = byte_of(line, static_cast<std::size_t>(skipped));
  const std::string_view shown = line.substr(begin);
  std::string text(shown.substr(0, byte_of(shown, whole)));
  for (char& c : text) {
    if (static_cast<unsigned char>(c) < ' ' && c != '\t') c = '?';  // control characters would reach the terminal
  }
  return {text, column - skipped};
}

}  // namespace hawser
