#include "solver/app/toml_document.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <tuple>

#include "solver/app/text_file.hpp"
#include "solver/app/toml_override.hpp"

namespace hawser {
namespace {

constexpr std::size_t largest_scene = 16u << 20;  // bytes; long histories belong into CSV files
constexpr std::size_t most_kept = 1000;           // diagnostics

Diagnostic about_file(const std::string& path, const std::string& message) {
  Diagnostic d;
  d.message = message;
  d.where = path;
  return d;
}

/// Item number `name` of a list, or the entry of a table; null where there is none.
const toml::node* child(const toml::node& node, const std::string& name) {
  if (const toml::table* table = node.as_table()) return table->get(name);
  std::size_t index = 0;
  const auto [end, failure] = std::from_chars(name.data(), name.data() + name.size(), index);
  const bool number = failure == std::errc() && end == name.data() + name.size();
  return number && node.is_array() ? node.as_array()->get(index) : nullptr;
}

}  // namespace

Document::Document(const std::string& path, const std::vector<std::string>& overrides) : path_(path) {
  auto content = read_text_file(path, largest_scene);
  if (const auto* trouble = std::get_if<FileTrouble>(&content)) throw InputError({about_file(path, "the scene file " + trouble->reason)});
  text_ = std::move(std::get<std::string>(content));
  lines_ = split_lines(text_);
  parse();
  for (const std::string& argument : overrides) {
    if (auto trouble = apply_override(root_, argument)) add(std::move(*trouble));
  }
}

void Document::parse() {
  try {
    root_ = parse_toml(text_, path_);
  } catch (const toml::parse_error& failure) {
    error(failure.source(), "not a valid scene file (TOML): " + std::string(failure.description()));
    throw InputError(diagnostics());
  }
}

void Document::error(const toml::source_region& region, std::string message, std::string label, std::vector<std::string> notes) {
  report(Severity::error, region, std::move(message), std::move(label), std::move(notes));
}

void Document::warn(const toml::source_region& region, std::string message, std::string label, std::vector<std::string> notes) {
  report(Severity::warning, region, std::move(message), std::move(label), std::move(notes));
}

void Document::error(const KeyPath& key, std::string message, std::string label, std::vector<std::string> notes) {
  report(Severity::error, region_of(key), std::move(message), std::move(label), std::move(notes));
}

void Document::warn(const KeyPath& key, std::string message, std::string label, std::vector<std::string> notes) {
  report(Severity::warning, region_of(key), std::move(message), std::move(label), std::move(notes));
}

void Document::add(Diagnostic diagnostic) {
  errors_ += diagnostic.severity == Severity::error;
  if (!full()) diagnostics_.push_back(std::move(diagnostic));
}

bool Document::full() const { return diagnostics_.size() >= most_kept; }

std::vector<Diagnostic> Document::diagnostics() const {
  std::vector<Diagnostic> sorted = diagnostics_;
  const auto order = [this](const Diagnostic& d) { return d.where == path_ ? std::tuple(0, d.place.line, d.place.column) : std::tuple(1, 0, 0); };
  std::stable_sort(sorted.begin(), sorted.end(), [&](const Diagnostic& a, const Diagnostic& b) { return order(a) < order(b); });
  return sorted;
}

Place Document::place(const toml::source_region& region) const {
  if (region.path && *region.path != path_) return {};
  return {static_cast<int>(region.begin.line), static_cast<int>(region.begin.column)};
}

const toml::source_region& Document::region_of(const KeyPath& key) const {
  const toml::node* node = &root_;
  for (const std::string& name : key) {
    const toml::node* next = child(*node, name);
    if (next == nullptr) break;
    node = next;
  }
  return node->source();
}

void Document::report(Severity severity, const toml::source_region& region, std::string message, std::string label, std::vector<std::string> notes) {
  Diagnostic d;
  d.severity = severity;
  d.message = std::move(message);
  d.label = std::move(label);
  d.notes = std::move(notes);
  d.place = place(region);
  d.where = d.place.line > 0 || !region.path ? path_ : *region.path;
  const auto line = static_cast<std::size_t>(d.place.line);
  if (line >= 1 && line <= lines_.size()) {
    const Excerpt shown = excerpt(lines_[line - 1], d.place.column);
    const bool one_line = region.end.line == region.begin.line;
    const int width = one_line ? static_cast<int>(region.end.column) - d.place.column : static_cast<int>(shown.text.size());
    d.source = shown.text;
    d.source_column = shown.column;
    d.width = std::clamp(width, 1, std::max(1, static_cast<int>(shown.text.size()) - shown.column + 1));
  }
  add(std::move(d));
}

std::vector<std::pair<const toml::key*, const toml::node*>> in_file_order(const toml::table& table) {
  std::vector<std::pair<const toml::key*, const toml::node*>> entries;
  for (const auto& [key, node] : table) entries.emplace_back(&key, &node);
  const auto order = [&](const auto& entry) {
    const toml::source_region& at = entry.first->source();
    const bool elsewhere = at.path != table.source().path;
    return std::tuple(elsewhere, at.begin.line, at.begin.column);
  };
  std::stable_sort(entries.begin(), entries.end(), [&](const auto& a, const auto& b) { return order(a) < order(b); });
  return entries;
}

}  // namespace hawser
