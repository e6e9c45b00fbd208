#include "solver/app/variation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>
#include <vector>

#include "solver/app/diagnostics.hpp"

namespace hawser {
namespace {

constexpr int most_values = 1'000'000;
constexpr double whole_below = 9007199254740992.0;  // 2^53: below it whole numbers are exact

struct Bound {
  double value;
  std::string unit;
};

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::vector<std::string_view> split(std::string_view text, char by) {
  std::vector<std::string_view> parts;
  for (std::size_t at = 0; at <= text.size();) {
    const std::size_t end = std::min(text.find(by, at), text.size());
    parts.push_back(trimmed(text.substr(at, end - at)));
    at = end + 1;
  }
  return parts;
}

std::optional<Bound> parse_bound(std::string_view text) {
  if (text.starts_with('+') && !text.starts_with("+-")) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc() || !std::isfinite(value)) return std::nullopt;
  return Bound{value, std::string(trimmed(text.substr(static_cast<std::size_t>(end - text.data()))))};
}

[[noreturn]] void refuse(const std::string& argument, const std::string& message) {
  Diagnostic d;
  d.message = message;
  d.where = argument;
  d.notes = {"write KEY=a:b:n, for example points.top.position.0=0:500:11 for 11 values from 0 to 500 m"};
  throw InputError({d});
}

/// first : last : count
void read_range(Variation& out, const std::string& argument, std::string_view range) {
  const std::vector<std::string_view> parts = split(range, ':');
  if (parts.size() != 3)
    refuse(argument, fmt::format("a range has three parts, first value, last value and number of values; this has {}", parts.size()));
  const std::optional<Bound> first = parse_bound(parts[0]), last = parse_bound(parts[1]);
  if (!first) refuse(argument, fmt::format("the first value `{}` is not a number", parts[0]));
  if (!last) refuse(argument, fmt::format("the last value `{}` is not a number", parts[1]));
  if (first->unit != last->unit) refuse(argument, fmt::format("both ends of the range need the same unit: `{}` and `{}` differ", parts[0], parts[1]));
  if (first->value == last->value) refuse(argument, "the first and the last value are the same");
  if (!std::isfinite(last->value - first->value)) refuse(argument, "the range is too wide");
  const auto [end, failure] = std::from_chars(parts[2].data(), parts[2].data() + parts[2].size(), out.count);
  const bool whole = failure == std::errc() && end == parts[2].data() + parts[2].size();
  if (!whole || out.count < 2 || out.count > most_values)
    refuse(argument, fmt::format("the number of values must be a whole number from 2 to {}, not `{}`", most_values, parts[2]));
  out.unit = first->unit;
  out.first = first->value;
  out.last = last->value;
}

}  // namespace

double Variation::value(double i) const { return i == count - 1 ? last : first + (last - first) * i / (count - 1); }

std::string Variation::override_at(double i) const {
  const double v = value(i);
  // Whole numbers without a point: keys such as `elements` want them so, and no key minds.
  const std::string number = v == std::floor(v) && std::abs(v) < whole_below ? fmt::format("{}", static_cast<long long>(v)) : fmt::format("{}", v);
  return fmt::format("{}={}{}{}", key, number, unit.empty() ? "" : " ", unit);
}

Variation parse_variation(const std::string& option, const std::string& text) {
  const std::string argument = option + " " + text;
  const std::size_t equals = std::min(text.find('='), text.size());
  Variation out;
  out.key = trimmed(std::string_view(text).substr(0, equals));
  if (out.key.empty() || equals == text.size()) refuse(argument, "there is no key with a range");
  if (out.key.find('[') != std::string::npos) refuse(argument, "items of a list are named by number, position.0 and not position[0]");
  read_range(out, argument, std::string_view(text).substr(equals + 1));
  return out;
}

}  // namespace hawser
