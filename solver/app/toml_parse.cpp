#include "solver/app/toml_parse.hpp"

#include <algorithm>
#include <memory>
#include <optional>

namespace hawser {
namespace {

constexpr int most_dots = 16;  // of a key; with the 256 levels of values that toml++ takes still far from the end of the stack

struct Hazard {
  const char* reason;
  toml::source_position position;
};

/// Just enough of TOML's lexing to tell keys from strings and comments. It may lose its way after a fault of syntax,
/// where toml++ stops.
class HazardScanner {
 public:
  explicit HazardScanner(std::string_view text) : text_(text) {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;  // byte order mark
  }

  std::optional<Hazard> scan() {
    int dots = 0;
    for (; at_ < text_.size(); ++at_) {
      const char c = text_[at_];
      if (!ascii(c)) return hazard("characters outside ASCII need quotes around them");
      if (c == '"' || c == '\'') {
        if (!skip_string(c)) return hazard("a line-ending backslash must not be followed by a character outside ASCII");
      } else if (c == '#') {
        at_ = std::min(text_.find('\n', at_), text_.size()) - 1;
      } else if (c == '.') {
        if (++dots > most_dots) return hazard("the key has too many parts");
      } else if (std::string_view("=,[]{}\n").find(c) != std::string_view::npos) {
        dots = 0;
      }
    }
    return std::nullopt;
  }

 private:
  static bool ascii(char c) { return static_cast<unsigned char>(c) < 0x80; }

  /// Moves to the closing quote, or to the end where there is none; false before a hazard within the string.
  bool skip_string(char quote) {
    const std::string three(3, quote);
    const bool block = text_.substr(at_, 3) == three;
    for (at_ += block ? 3 : 1; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\\' && quote == '"') {
        const std::size_t next = block ? text_.find_first_not_of(" \t\r\n", at_ + 1) : at_ + 1;
        if (next >= text_.size()) break;
        const bool escape = next == at_ + 1;
        at_ = next;
        if (block && !ascii(text_[at_])) return false;
        if (!escape) --at_;  // the character after a line-ending backslash stands for itself
      } else if (block ? text_.substr(at_, 3) == three : (text_[at_] == quote || text_[at_] == '\n')) {
        if (block) at_ = std::min(text_.find_first_not_of(quote, at_), text_.size()) - 1;  // """ may close after one or two quotes
        return true;
      }
    }
    at_ = text_.size();
    return true;
  }

  Hazard hazard(const char* reason) const {
    const std::string_view before = text_.substr(0, at_);
    const std::string_view line = before.substr(before.rfind('\n') + 1);  // npos + 1 = 0: the first line
    const auto lines = std::count(before.begin(), before.end(), '\n');
    const auto characters = std::count_if(line.begin(), line.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
    return {reason, {static_cast<toml::source_index>(lines + 1), static_cast<toml::source_index>(characters + 1)}};
  }

  std::string_view text_;
  std::size_t at_ = 0;
};

}  // namespace

toml::table parse_toml(std::string_view text, const std::string& source) {
  if (const std::optional<Hazard> hazard = HazardScanner(text).scan()) {
    throw toml::parse_error(hazard->reason, hazard->position, std::make_shared<const std::string>(source));
  }
  return toml::parse(text, std::string_view(source));
}

}  // namespace hawser
