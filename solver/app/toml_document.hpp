// A parsed scene file with its overrides, and the messages about it.
//
// Every value knows where it was written: in the file (line, column) or in an override (`--set key=value`), so that a
// message can point at it whoever finds the fault. Keys are named by their dotted path, as in --set: `lines.a.sections.0`.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "assembly/scene.hpp"
#include "solver/app/diagnostics.hpp"
#include "solver/app/toml_parse.hpp"

namespace hawser {

/// A path into the document; list items by their number.
using KeyPath = std::vector<std::string>;

class Document {
 public:
  /// Reads and parses the file and applies the overrides. Throws InputError where the file cannot be parsed.
  Document(const std::string& path, const std::vector<std::string>& overrides);

  const std::string& path() const { return path_; }
  const std::string& text() const { return text_; }
  const toml::table& root() const { return root_; }

  void error(const toml::source_region& region, std::string message, std::string label = {}, std::vector<std::string> notes = {});
  void warn(const toml::source_region& region, std::string message, std::string label = {}, std::vector<std::string> notes = {});

  /// The same, at the value of a key, or at the nearest table above it that was written.
  void error(const KeyPath& key, std::string message, std::string label = {}, std::vector<std::string> notes = {});
  void warn(const KeyPath& key, std::string message, std::string label = {}, std::vector<std::string> notes = {});

  /// A finished diagnostic, of another file.
  void add(Diagnostic diagnostic);

  /// Where a value was written in the file; 0, 0 for an override.
  Place place(const toml::source_region& region) const;

  bool failed() const { return errors_ > 0; }
  std::size_t reported() const { return diagnostics_.size(); }
  /// So much was reported that more is not kept: loops over entries may stop.
  bool full() const;
  /// Everything reported, in the order of the file; other files and overrides after it.
  std::vector<Diagnostic> diagnostics() const;

 private:
  void parse();
  const toml::source_region& region_of(const KeyPath& key) const;
  void report(Severity severity, const toml::source_region& region, std::string message, std::string label, std::vector<std::string> notes);

  std::string path_;
  std::string text_;
  std::vector<std::string_view> lines_;  // views into text_
  toml::table root_;
  std::vector<Diagnostic> diagnostics_;
  int errors_ = 0;
};

/// The entries of a table in the order of the file (toml++ sorts them by name), overrides last.
std::vector<std::pair<const toml::key*, const toml::node*>> in_file_order(const toml::table& table);

}  // namespace hawser
