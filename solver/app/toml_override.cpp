#include "solver/app/toml_override.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <vector>

#include "solver/app/toml_parse.hpp"

namespace hawser {
namespace {

Diagnostic trouble(const std::string& argument, std::string message, std::string label = {}) {
  Diagnostic d;
  d.message = std::move(message);
  d.where = "--set " + argument;
  d.label = std::move(label);
  return d;
}

std::vector<std::string> names_in(const toml::table& table) {
  std::vector<std::string> names;
  for (const auto& entry : table) names.emplace_back(entry.first.str());
  return names;
}

/// A value that is a word or has a blank, such as 4 km, put into quotes.
std::string quoted(const std::string& argument, std::size_t equals) {
  std::string out = argument.substr(0, equals + 1) + '"';
  std::string_view value = std::string_view(argument).substr(equals + 1);
  value.remove_prefix(std::min(value.find_first_not_of(" \t"), value.size()));
  for (char c : value) {
    if (c == '"' || c == '\\') out += '\\';
    out += c;
  }
  return out + '"';
}

toml::table parse_argument(const std::string& argument) {
  const std::string source = "--set " + argument;
  const std::size_t equals = argument.find('=');
  try {
    return parse_toml(argument, source);
  } catch (const toml::parse_error&) {
    const std::size_t value = equals == std::string::npos ? equals : argument.find_first_not_of(" \t", equals + 1);
    const bool literal = value == std::string::npos || std::string_view("[{\"'").find(argument[value]) != std::string_view::npos;
    if (literal) throw;
  }
  return parse_toml(quoted(argument, equals), source);
}

/// Follows the single chain of keys of `patch` through the document and puts its value there.
class Patcher {
 public:
  Patcher(toml::table& root, const std::string& argument) : root_(root), argument_(argument) {}

  std::optional<Diagnostic> apply(toml::table& patch) { return put(root_, patch); }

 private:
  static bool leaf(const toml::node& node) { return !node.is_table() || node.as_table()->is_inline(); }

  std::optional<Diagnostic> put(toml::node& target, toml::table& patch) {
    if (patch.size() != 1) return trouble(argument_, "an override sets one key: key.path=value");
    const auto entry = *patch.begin();  // a pair of references
    if (toml::array* array = target.as_array()) return put_item(*array, std::string(entry.first.str()), entry.second);
    if (toml::table* table = target.as_table()) return put_entry(*table, entry.first, entry.second);
    return trouble(argument_, fmt::format("`{}` holds a single value, it has no key `{}`", path_, entry.first.str()));
  }

  std::optional<Diagnostic> put_entry(toml::table& table, const toml::key& key, toml::node& value) {
    toml::node* existing = table.get(key.str());
    if (existing == nullptr && !leaf(value) && has_user_names()) {
      return trouble(argument_, fmt::format("`{}` has no `{}`", path_, key.str()), did_you_mean(key.str(), names_in(table)));
    }
    if (existing == nullptr || leaf(value)) {
      table.insert_or_assign(key, std::move(value));
      return std::nullopt;
    }
    path_ += (path_.empty() ? "" : ".") + std::string(key.str());
    return put(*existing, *value.as_table());
  }

  std::optional<Diagnostic> put_item(toml::array& array, const std::string& number, toml::node& value) {
    std::size_t index = 0;
    const auto [end, failure] = std::from_chars(number.data(), number.data() + number.size(), index);
    if (failure != std::errc() || end != number.data() + number.size() || index >= array.size()) {
      const std::string range = array.empty() ? "is empty" : fmt::format("is a list: use a number from 0 to {}", array.size() - 1);
      return trouble(argument_, fmt::format("`{}` {}, not `{}`", path_, range, number));
    }
    path_ += "." + number;
    if (!leaf(value)) return put(array[index], *value.as_table());
    array.replace(array.cbegin() + static_cast<std::ptrdiff_t>(index), std::move(value));
    return std::nullopt;
  }

  bool has_user_names() const { return path_ == "lines" || path_ == "points" || path_ == "line_types"; }

  toml::table& root_;
  const std::string& argument_;
  std::string path_;
};

}  // namespace

std::optional<Diagnostic> apply_override(toml::table& root, const std::string& argument) {
  if (argument.find('=') == std::string::npos) return trouble(argument, "an override is written key.path=value; there is no `=`");
  try {
    toml::table patch = parse_argument(argument);
    return Patcher(root, argument).apply(patch);
  } catch (const toml::parse_error& failure) {
    return trouble(argument, "not a valid override: " + std::string(failure.description()));
  }
}

}  // namespace hawser
