#include "solver/app/toml_table.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>

namespace hawser {
namespace {

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

std::string range_text(const Quantity& quantity) {
  const Range& r = quantity.range;
  const std::string unit = *quantity.kind.unit == '\0' ? "" : fmt::format(" {}", quantity.kind.unit);
  if (std::isinf(r.high)) return r.low == 0.0 && !r.open ? "must not be negative" : fmt::format("must be greater than {:g}{}", r.low, unit);
  return fmt::format("must be {} {:g} and at most {:g}{}", r.open ? "greater than" : "at least", r.low, r.high, unit);
}

std::string wanted_text(const Kind& kind) {
  if (kind.dimension == Dimension{}) return "a number";
  const char* article = std::string_view("aeiou").find(kind.name[0]) == std::string_view::npos ? "a" : "an";
  return fmt::format("{} {}: a number in {}, or a string with a unit such as \"{}\"", article, kind.name, kind.unit, kind.example);
}

/// The number written, in SI, or NaN with a report.
double number_as_written(Document& document, const toml::node& node, const Kind& kind, const std::string& name) {
  if (node.is_integer()) return from_bare(static_cast<double>(node.as_integer()->get()), kind);
  if (node.is_floating_point()) return from_bare(node.as_floating_point()->get(), kind);
  if (!node.is_string()) {
    document.error(node.source(), fmt::format("`{}` must be {}", name, wanted_text(kind)), fmt::format("this is {}", type_of(node)));
    return nan;
  }
  const auto parsed = parse_quantity(node.as_string()->get(), kind);
  if (const double* value = std::get_if<double>(&parsed)) return *value;
  document.error(node.source(), fmt::format("`{}` must be {}", name, wanted_text(kind)), std::get<BadQuantity>(parsed).reason);
  return nan;
}

bool within(double value, const Range& range) { return value <= range.high && (range.open ? value > range.low : value >= range.low); }

}  // namespace

std::string type_of(const toml::node& node) {
  switch (node.type()) {
    case toml::node_type::table:
      return "a table";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::string:
      return "a string";
    case toml::node_type::integer:
    case toml::node_type::floating_point:
      return "a number";
    case toml::node_type::boolean:
      return "a boolean";
    default:
      return "a date or time";
  }
}

double read_number(Document& document, const toml::node& node, const Quantity& quantity, const std::string& name) {
  const std::size_t before = document.reported();
  const double value = number_as_written(document, node, quantity.kind, name);
  if (document.reported() > before) return nan;
  if (!std::isfinite(value)) {
    document.error(node.source(), fmt::format("`{}` must be finite", name));
    return nan;
  }
  if (within(value, quantity.range)) return value;
  document.error(node.source(), fmt::format("`{}` {}", name, range_text(quantity)), fmt::format("out of range: {:g}", value));
  return nan;
}

std::vector<double> read_numbers(Document& document, const toml::node& node, const std::vector<Quantity>& quantities, const std::string& name) {
  const toml::array* array = node.as_array();
  if (array == nullptr || array->size() != quantities.size()) {
    const std::string found = array == nullptr ? type_of(node) : fmt::format("a list of {}", array->size());
    document.error(node.source(), fmt::format("`{}` must be a list of {} numbers", name, quantities.size()), fmt::format("this is {}", found));
    return {};
  }
  std::vector<double> values;
  for (std::size_t i = 0; i < quantities.size(); ++i) {
    values.push_back(read_number(document, (*array)[i], quantities[i], fmt::format("{}.{}", name, i)));
  }
  return values;
}

Vec3 read_vector(Document& document, const toml::node& node, const Kind& kind, const std::string& name) {
  const std::vector<double> values = read_numbers(document, node, {{kind}, {kind}, {kind}}, name);
  return values.empty() ? Vec3::Constant(nan) : Vec3(values[0], values[1], values[2]);
}

TableReader::TableReader(Document& document, const toml::table& table, std::string path)
    : document_(document), table_(table), path_(std::move(path)) {}

std::string TableReader::path_of(std::string_view key) const { return path_.empty() ? std::string(key) : fmt::format("{}.{}", path_, key); }

const toml::node* TableReader::find(std::string_view key) {
  if (std::find(known_.begin(), known_.end(), key) == known_.end()) known_.emplace_back(key);
  return table_.get(key);
}

const toml::node* TableReader::require(std::string_view key) {
  const toml::node* node = find(key);
  if (node == nullptr) missing_.emplace_back(key);
  return node;
}

double TableReader::number(std::string_view key, const Quantity& quantity) {
  const toml::node* node = require(key);
  return node == nullptr ? nan : read_number(document_, *node, quantity, path_of(key));
}

double TableReader::number(std::string_view key, const Quantity& quantity, double fallback) { return maybe_number(key, quantity).value_or(fallback); }

std::optional<double> TableReader::maybe_number(std::string_view key, const Quantity& quantity) {
  const toml::node* node = find(key);
  if (node == nullptr) return std::nullopt;
  return read_number(document_, *node, quantity, path_of(key));
}

int TableReader::integer(std::string_view key, int low, int high, int fallback) {
  const toml::node* node = find(key);
  if (node == nullptr) return fallback;
  const std::optional<double> value = node->value<double>();
  if (value && *value >= low && *value <= high && *value == std::floor(*value)) return static_cast<int>(*value);
  document_.error(node->source(), fmt::format("`{}` must be a whole number from {} to {}", path_of(key), low, high),
                  value ? "out of range or not whole" : fmt::format("this is {}", type_of(*node)));
  return fallback;
}

bool TableReader::boolean(std::string_view key, bool fallback) {
  const toml::node* node = find(key);
  if (node == nullptr) return fallback;
  if (node->is_boolean()) return node->as_boolean()->get();
  wrong_type(*node, key, "true or false");
  return fallback;
}

Vec3 TableReader::vector(std::string_view key, const Kind& kind) {
  const toml::node* node = require(key);
  return node == nullptr ? Vec3::Constant(nan) : read_vector(document_, *node, kind, path_of(key));
}

std::string TableReader::text(std::string_view key) { return require(key) == nullptr ? "" : text(key, ""); }

std::string TableReader::text(std::string_view key, const std::string& fallback) {
  const toml::node* node = find(key);
  if (node == nullptr) return fallback;
  if (node->is_string()) return node->as_string()->get();
  wrong_type(*node, key, "a string");
  return "";
}

std::size_t TableReader::choice(std::string_view key, const std::vector<std::string>& allowed) {
  const toml::node* node = find(key);
  if (node == nullptr) return 0;
  const toml::value<std::string>* word = node->as_string();
  if (word != nullptr) {
    const auto at = std::find(allowed.begin(), allowed.end(), word->get());
    if (at != allowed.end()) return static_cast<std::size_t>(at - allowed.begin());
  }
  document_.error(node->source(), fmt::format("`{}` must be one of \"{}\"", path_of(key), fmt::join(allowed, "\", \"")),
                  word ? did_you_mean(word->get(), allowed) : fmt::format("this is {}", type_of(*node)));
  return 0;
}

const toml::table* TableReader::find_table(std::string_view key) {
  const toml::node* node = find(key);
  if (node != nullptr && !node->is_table()) wrong_type(*node, key, "a table");
  return node == nullptr ? nullptr : node->as_table();
}

const toml::array* TableReader::find_array(std::string_view key) {
  const toml::node* node = find(key);
  if (node != nullptr && !node->is_array()) wrong_type(*node, key, "a list");
  return node == nullptr ? nullptr : node->as_array();
}

bool TableReader::holds_word(std::string_view key, std::string_view word) {
  const toml::node* node = find(key);
  return node != nullptr && node->is_string() && node->as_string()->get() == word;
}

void TableReader::error_at(std::string_view key, std::string message, std::string label, std::vector<std::string> notes) {
  const toml::node* node = find(key);
  document_.error(node ? node->source() : table_.source(), std::move(message), std::move(label), std::move(notes));
}

void TableReader::not_built(std::string_view key, const std::string& what, const std::string& remedy) {
  error_at(key, fmt::format("{} is not built yet", what), fmt::format("`{}` is not built yet", key),
           remedy.empty() ? std::vector<std::string>{} : std::vector<std::string>{remedy});
}

void TableReader::finish() {
  for (const auto& [key, node] : in_file_order(table_)) {
    if (document_.full()) return;
    if (std::find(known_.begin(), known_.end(), key->str()) != known_.end()) continue;
    const std::string place = path_.empty() ? "at the top of the scene" : fmt::format("in `{}`", path_);
    document_.error(key->source(), fmt::format("unknown key `{}` {}", key->str(), place), did_you_mean(key->str(), known_),
                    {fmt::format("allowed: {}", fmt::join(known_, ", "))});
    std::erase(missing_, nearest(key->str(), known_));
  }
  for (const std::string& key : missing_) {
    document_.error(table_.source(), fmt::format("`{}` is missing", path_of(key)), fmt::format("needs `{}`", key));
  }
}

void TableReader::wrong_type(const toml::node& node, std::string_view key, const std::string& wanted) {
  document_.error(node.source(), fmt::format("`{}` must be {}", path_of(key), wanted), fmt::format("this is {}", type_of(node)));
}

}  // namespace hawser
