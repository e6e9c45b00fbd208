// TableReader: one table of the scene file, key by key, with type, unit and range checks.
//
// A value that is missing or wrong is reported in the Document and comes back as NaN (numbers), an empty string or an
// empty optional: reading goes on, and later checks, written so that NaN never trips them, do not report it again.
// The keys asked for are the keys allowed: finish() reports all others.
#pragma once

#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "assembly/scene.hpp"
#include "solver/app/toml_document.hpp"
#include "solver/app/units.hpp"

namespace hawser {

/// Closed interval, or open at `low`. Every number must also be finite.
struct Range {
  double low = -std::numeric_limits<double>::infinity();
  double high = std::numeric_limits<double>::infinity();
  bool open = false;
};
inline constexpr Range any_value{};
inline constexpr Range not_negative{0.0, std::numeric_limits<double>::infinity(), false};
inline constexpr Range positive{0.0, std::numeric_limits<double>::infinity(), true};

struct Quantity {
  Kind kind;
  Range range = any_value;
};

/// A number, or a string with a unit, in SI. `name` is the dotted path for the message.
double read_number(Document& document, const toml::node& node, const Quantity& quantity, const std::string& name);

/// A list of exactly `count` numbers, each with its quantity; empty where that failed.
std::vector<double> read_numbers(Document& document, const toml::node& node, const std::vector<Quantity>& quantities, const std::string& name);

/// [x, y, z]; a vector of NaN where that failed.
Vec3 read_vector(Document& document, const toml::node& node, const Kind& kind, const std::string& name);

class TableReader {
 public:
  /// `path` is the dotted path of the table, empty for the whole file.
  TableReader(Document& document, const toml::table& table, std::string path);

  Document& document() const { return document_; }
  const toml::table& table() const { return table_; }
  std::string path_of(std::string_view key) const;
  Place place() const { return document_.place(table_.source()); }

  /// The value of a key, or null; from now on the key is known.
  const toml::node* find(std::string_view key);
  /// The same for a key that finish() reports if it is missing and not just misspelt.
  const toml::node* require(std::string_view key);

  double number(std::string_view key, const Quantity& quantity);
  double number(std::string_view key, const Quantity& quantity, double fallback);
  std::optional<double> maybe_number(std::string_view key, const Quantity& quantity);
  int integer(std::string_view key, int low, int high, int fallback);
  bool boolean(std::string_view key, bool fallback);
  Vec3 vector(std::string_view key, const Kind& kind);
  std::string text(std::string_view key);
  std::string text(std::string_view key, const std::string& fallback);
  /// The position in `allowed` of the word that the key holds; 0 where it is absent or wrong.
  std::size_t choice(std::string_view key, const std::vector<std::string>& allowed);

  /// A table, or null where it is absent or something else (reported).
  const toml::table* find_table(std::string_view key);
  /// A list, the same.
  const toml::array* find_array(std::string_view key);

  /// True where the key holds this word, "auto" above all.
  bool holds_word(std::string_view key, std::string_view word);

  void error_at(std::string_view key, std::string message, std::string label = {}, std::vector<std::string> notes = {});
  void not_built(std::string_view key, const std::string& what, const std::string& remedy = {});

  /// Reports keys that nobody asked for, and required keys that are missing.
  void finish();

 private:
  void wrong_type(const toml::node& node, std::string_view key, const std::string& wanted);

  Document& document_;
  const toml::table& table_;
  std::string path_;
  std::vector<std::string> known_, missing_;
};

/// "a number", "a string", ... for messages.
std::string type_of(const toml::node& node);

}  // namespace hawser
