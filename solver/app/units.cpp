#include "solver/app/units.hpp"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>
#include <numbers>
#include <optional>
#include <vector>

#include "solver/app/diagnostics.hpp"

namespace hawser {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

struct Symbol {
  std::string_view name;
  double factor;  // to SI
  Dimension dimension;
  bool prefixed;  // takes SI prefixes
};

constexpr Dimension none{}, length{0, 1, 0, 0}, area{0, 2, 0, 0}, volume{0, 3, 0, 0}, time{0, 0, 1, 0}, speed{0, 1, -1, 0}, angle{0, 0, 0, 1},
    mass{1, 0, 0, 0}, force{1, 1, -2, 0}, pressure{1, -1, -2, 0};

constexpr std::array symbols{
    Symbol{"m", 1.0, length, true},
    Symbol{"g", 1e-3, mass, true},
    Symbol{"s", 1.0, time, true},
    Symbol{"N", 1.0, force, true},
    Symbol{"Pa", 1.0, pressure, true},
    Symbol{"rad", 1.0, angle, true},
    Symbol{"L", 1e-3, volume, true},
    Symbol{"1", 1.0, none, false},
    Symbol{"%", 0.01, none, false},
    Symbol{"deg", degree, angle, false},
    Symbol{"°", degree, angle, false},
    Symbol{"min", 60.0, time, false},
    Symbol{"h", 3600.0, time, false},
    Symbol{"t", 1000.0, mass, false},
    Symbol{"lb", 0.45359237, mass, false},
    Symbol{"kgf", 9.80665, force, false},
    Symbol{"tf", 9806.65, force, false},
    Symbol{"lbf", 4.4482216152605, force, false},
    Symbol{"in", 0.0254, length, false},
    Symbol{"ft", 0.3048, length, false},
    Symbol{"nmi", 1852.0, length, false},
    Symbol{"ha", 1e4, area, false},
    Symbol{"kn", 1852.0 / 3600.0, speed, false},
    Symbol{"kt", 1852.0 / 3600.0, speed, false},
    Symbol{"kts", 1852.0 / 3600.0, speed, false},
    Symbol{"knot", 1852.0 / 3600.0, speed, false},
    Symbol{"knots", 1852.0 / 3600.0, speed, false},
};

struct Prefix {
  std::string_view name;
  double factor;
};
constexpr std::array prefixes{Prefix{"n", 1e-9}, Prefix{"u", 1e-6}, Prefix{"µ", 1e-6}, Prefix{"m", 1e-3}, Prefix{"c", 1e-2},
                              Prefix{"d", 1e-1}, Prefix{"k", 1e3},  Prefix{"M", 1e6},  Prefix{"G", 1e9}};

constexpr std::array all_kinds{kinds::number,           kinds::length,         kinds::area,
                               kinds::volume,           kinds::time,           kinds::speed,
                               kinds::acceleration,     kinds::angle,          kinds::mass,
                               kinds::mass_per_length,  kinds::density,        kinds::force,
                               kinds::force_per_length, kinds::force_per_area, kinds::force_times_time,
                               kinds::damping_per_area, kinds::moment,         kinds::bending_stiffness};

struct Unit {
  double factor = 1.0;
  Dimension dimension;
};

/// One symbol with its prefix; a symbol as a whole goes before a prefixed one ("min", "ft", "kn").
std::optional<Unit> find_symbol(std::string_view name) {
  for (const Symbol& symbol : symbols) {
    if (name == symbol.name) return Unit{symbol.factor, symbol.dimension};
  }
  for (const Prefix& prefix : prefixes) {
    if (!name.starts_with(prefix.name)) continue;
    for (const Symbol& symbol : symbols) {
      if (symbol.prefixed && name.substr(prefix.name.size()) == symbol.name) return Unit{prefix.factor * symbol.factor, symbol.dimension};
    }
  }
  return std::nullopt;
}

std::string unknown_unit(std::string_view name) {
  static constexpr std::array common{"mm", "cm", "km", "kg", "ms", "kN", "MN", "kPa", "MPa", "GPa"};
  std::vector<std::string> known(common.begin(), common.end());
  for (const Symbol& symbol : symbols) known.emplace_back(symbol.name);
  const std::string guess = did_you_mean(name, known);
  return fmt::format("`{}` is not a unit{}{}", name, guess.empty() ? "" : "; ", guess);
}

/// Rewrites the characters people paste: superscripts, the middle dot, "**".
std::string plain(std::string_view text) {
  std::string out(text);
  static constexpr std::array<std::pair<std::string_view, std::string_view>, 4> from_to{{{"²", "2"}, {"³", "3"}, {"·", " "}, {"**", "^"}}};
  for (const auto& [from, to] : from_to) {
    for (std::size_t at = out.find(from); at != std::string::npos; at = out.find(from, at + to.size())) out.replace(at, from.size(), to);
  }
  return out;
}

/// "m3", "s^2", "m-1" split into symbol and power.
struct Factor {
  std::string_view name;
  int power = 1;
};

std::optional<Factor> split_power(std::string_view token) {
  if (token == "1") return Factor{token, 1};
  const std::size_t at = token.find_first_of("^+-0123456789");
  if (at == std::string_view::npos) return Factor{token, 1};
  std::string_view digits = token.substr(at);
  if (digits.front() == '^') digits.remove_prefix(1);
  int power = 0;
  const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), power);
  if (at == 0 || failure != std::errc() || end != digits.data() + digits.size() || std::abs(power) > 9) return std::nullopt;
  return Factor{token.substr(0, at), power};
}

void multiply(Unit& unit, const Unit& by, int power) {
  unit.factor *= std::pow(by.factor, power);
  unit.dimension.kilogram += power * by.dimension.kilogram;
  unit.dimension.metre += power * by.dimension.metre;
  unit.dimension.second += power * by.dimension.second;
  unit.dimension.radian += power * by.dimension.radian;
}

std::variant<Unit, BadQuantity> parse_unit(const std::string& text) {
  Unit unit;
  int sign = 1;
  std::size_t at = 0;
  while ((at = text.find_first_not_of(" \t*", at)) != std::string::npos) {
    if (text[at] == '/') {
      if (sign < 0) return BadQuantity{fmt::format("`{}` has two `/` in a row", text)};
      sign = -1;
      ++at;
      continue;
    }
    const std::size_t end = std::min(text.find_first_of(" \t*/", at), text.size());
    const std::string_view token = std::string_view(text).substr(at, end - at);
    const std::optional<Factor> factor = split_power(token);
    const std::optional<Unit> symbol = factor ? find_symbol(factor->name) : std::nullopt;
    if (!symbol) return BadQuantity{unknown_unit(token)};
    multiply(unit, *symbol, sign * factor->power);
    sign = 1;
    at = end;
  }
  if (sign < 0) return BadQuantity{fmt::format("`{}` ends with `/`", text)};
  return unit;
}

std::string_view trimmed(std::string_view text) {
  const std::size_t first = text.find_first_not_of(" \t");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

}  // namespace

std::string kind_of(const Dimension& dimension) {
  for (const Kind& kind : all_kinds) {
    if (kind.dimension == dimension) return kind.name;
  }
  return "something else";
}

std::variant<double, BadQuantity> parse_quantity(std::string_view text, const Kind& kind) {
  text = trimmed(text);
  std::string_view rest = text;
  if (rest.starts_with('+') && !rest.starts_with("+-")) rest.remove_prefix(1);
  double value = 0.0;
  const auto [end, failure] = std::from_chars(rest.data(), rest.data() + rest.size(), value);
  if (failure == std::errc::invalid_argument) return BadQuantity{text.empty() ? "empty text" : "does not begin with a number"};
  if (failure != std::errc()) return BadQuantity{"the number is too large or too small"};
  const std::string unit_text = plain(trimmed(rest.substr(static_cast<std::size_t>(end - rest.data()))));
  if (unit_text.empty()) return BadQuantity{"a number in quotes needs a unit"};
  const auto unit = parse_unit(unit_text);
  if (const auto* bad = std::get_if<BadQuantity>(&unit)) return *bad;
  const Unit& found = std::get<Unit>(unit);
  if (found.dimension != kind.dimension) return BadQuantity{fmt::format("`{}` is a unit of {}", unit_text, kind_of(found.dimension))};
  return value * found.factor;
}

double from_bare(double value, const Kind& kind) { return kind.dimension == angle ? value * degree : value; }

}  // namespace hawser
