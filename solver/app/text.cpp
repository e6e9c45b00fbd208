#include "solver/app/text.hpp"

#include <fmt/core.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

namespace hawser {

std::string with_prefix(double value, std::string_view unit) {
  struct Prefix {
    double factor;
    std::string_view letter;
  };
  static constexpr std::array<Prefix, 5> prefixes{{{1e9, "G"}, {1e6, "M"}, {1e3, "k"}, {1.0, ""}, {1e-3, "m"}}};
  // 999.5 already prints as 1000 with three digits, so it belongs to the next prefix.
  const double size = std::abs(value) * (1.0 + 5e-4);
  if (value == 0.0) return fmt::format("0 {}", unit);
  if (!std::isfinite(value) || size < 1e-3) return fmt::format("{:.3g} {}", value, unit);
  const auto prefix = std::find_if(prefixes.begin(), prefixes.end() - 1, [&](const Prefix& p) { return size >= p.factor; });
  const double scaled = value / prefix->factor;
  const double digits = std::abs(scaled);
  const int decimals = digits < 9.995 ? 2 : digits < 99.95 ? 1 : 0;
  return fmt::format("{:.{}f} {}{}", scaled, decimals, prefix->letter, unit);
}

std::string clock_text(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0.0) return "--:--";
  const long s = std::lround(std::min(seconds, 1e9));
  if (s < 3600) return fmt::format("{:02}:{:02}", s / 60, s % 60);
  return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

std::string decimal_text(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_not_of("-0123456789") == std::string::npos) text += ".0";
  return text;
}

namespace {

/// Characters, not bytes: continuation bytes of UTF-8 take no room.
std::size_t width(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) { return (c & 0xC0) != 0x80; }));
}

}  // namespace

std::string table(const std::vector<std::vector<std::string>>& rows) {
  std::vector<std::size_t> widths;
  for (const auto& row : rows) {
    widths.resize(std::max(widths.size(), row.size()), 0);
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], width(row[c]));
  }
  std::string text;
  for (const auto& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) {
      const std::string padding(widths[c] - width(row[c]), ' ');
      line += c == 0 ? row[c] + padding : "  " + padding + row[c];
    }
    line.erase(line.find_last_not_of(' ') + 1);
    text += line + '\n';
  }
  return text;
}

bool is_terminal(std::FILE* stream) { return isatty(fileno(stream)) == 1; }

std::string painted(std::FILE* stream, int colour, std::string_view text) {
  const char* no_color = std::getenv("NO_COLOR");
  const bool plain = (no_color != nullptr && *no_color != '\0') || !is_terminal(stream);
  return plain ? std::string(text) : fmt::format("\x1b[{}m{}\x1b[0m", colour, text);
}

void say_error(std::string_view text) { fmt::print(stderr, "{} {}\n", painted(stderr, 31, "error:"), text); }

void say_warning(std::string_view text) { fmt::print(stderr, "{} {}\n", painted(stderr, 33, "warning:"), text); }

}  // namespace hawser
