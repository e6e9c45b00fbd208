#include "solver/app/table_file.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <charconv>
#include <cmath>

#include "solver/app/text_file.hpp"

namespace hawser {
namespace {

constexpr std::size_t largest_table = 64u << 20;  // bytes
constexpr int most_reported = 10;                 // faults in one file

struct Cell {
  std::string_view text;
  int column;  // of its first character in the line, from 1
};

std::vector<Cell> split_cells(std::string_view line) {
  std::vector<Cell> cells;
  std::size_t begin = 0;
  while (true) {
    const std::size_t end = std::min(line.find(',', begin), line.size());
    std::size_t first = begin, last = end;
    while (first < last && (line[first] == ' ' || line[first] == '\t')) ++first;
    while (last > first && (line[last - 1] == ' ' || line[last - 1] == '\t')) --last;
    cells.push_back({line.substr(first, last - first), static_cast<int>(first) + 1});
    if (end == line.size()) return cells;
    begin = end + 1;
  }
}

bool skipped(std::string_view line) {
  const std::size_t first = line.find_first_not_of(" \t");
  return first == std::string_view::npos || line[first] == '#';
}

std::optional<double> finite_number(std::string_view text) {
  if (text.starts_with('+')) text.remove_prefix(1);
  double value = 0.0;
  const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (failure != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

class TableParser {
 public:
  TableParser(Document& document, const std::string& path, std::string_view text, const std::vector<std::string>& columns, FirstColumn first)
      : document_(document), path_(path), lines_(split_lines(text)), columns_(columns), named_(first == FirstColumn::name) {
    if (!lines_.empty() && lines_[0].starts_with("\xEF\xBB\xBF")) lines_[0].remove_prefix(3);
  }

  TableFile parse() {
    TableFile table;
    std::size_t at = 0;
    while (at < lines_.size() && skipped(lines_[at])) ++at;
    if (!header(at)) return {};
    const std::size_t header_line = at;
    for (++at; at < lines_.size() && faults_ < most_reported; ++at) {
      if (!skipped(lines_[at])) add_row(table, at);
    }
    if (table.rows.empty() && faults_ == 0) fault(header_line, {lines_[header_line], 1}, "the table has no rows");
    if (faults_ > 0) return {};
    return table;
  }

 private:
  bool header(std::size_t at) {
    const std::string wanted = fmt::format("the first line must be `{}`", fmt::join(columns_, ","));
    if (at >= lines_.size()) return fault(0, {}, "the table is empty; " + wanted);
    const std::vector<Cell> cells = split_cells(lines_[at]);
    bool same = cells.size() == columns_.size();
    for (std::size_t i = 0; same && i < cells.size(); ++i) same = cells[i].text == columns_[i];
    return same || fault(at, {lines_[at], 1}, wanted);
  }

  void add_row(TableFile& table, std::size_t at) {
    const std::vector<Cell> cells = split_cells(lines_[at]);
    if (cells.size() != columns_.size()) {
      fault(at, {lines_[at], 1}, fmt::format("{} values in a row, {} wanted ({})", cells.size(), columns_.size(), fmt::join(columns_, ",")));
      return;
    }
    TableFile::Row row;
    row.line = static_cast<int>(at) + 1;
    if (named_) row.name = cells[0].text;
    for (std::size_t i = named_ ? 1 : 0; i < cells.size(); ++i) {
      const std::optional<double> value = finite_number(cells[i].text);
      if (!value) fault(at, cells[i], fmt::format("`{}` must be a finite number", columns_[i]));
      row.value.push_back(value.value_or(0.0));
    }
    table.rows.push_back(std::move(row));
  }

  bool fault(std::size_t at, const Cell& cell, const std::string& message) {
    Diagnostic d;
    d.message = message;
    d.where = path_;
    d.place = {static_cast<int>(at) + 1, std::max(cell.column, 1)};
    if (at < lines_.size()) {
      const Excerpt shown = excerpt(lines_[at], d.place.column);
      d.source = shown.text;
      d.source_column = shown.column;
      d.width = static_cast<int>(std::min<std::size_t>(cell.text.size(), shown.text.size()));
    }
    document_.add(std::move(d));
    ++faults_;
    return false;
  }

  Document& document_;
  const std::string& path_;
  std::vector<std::string_view> lines_;
  const std::vector<std::string>& columns_;
  bool named_;
  int faults_ = 0;
};

}  // namespace

TableFile read_table_file(Document& document, const toml::node& named_at, const std::string& file, const std::vector<std::string>& columns,
                          FirstColumn first) {
  const std::string path = path_beside(document.path(), file);
  const auto content = read_text_file(path, largest_table);
  if (const auto* trouble = std::get_if<FileTrouble>(&content)) {
    document.error(named_at.source(), fmt::format("the file `{}` {}", path, trouble->reason), trouble->reason);
    return {};
  }
  TableFile table = TableParser(document, path, std::get<std::string>(content), columns, first).parse();
  table.path = path;
  return table;
}

void report_row(Document& document, const TableFile& table, const TableFile::Row& row, const std::string& message) {
  Diagnostic d;
  d.message = message;
  d.where = table.path;
  d.place = {row.line, 1};
  document.add(std::move(d));
}

bool increases(Document& document, const TableFile& table, std::size_t column, const std::string& name) {
  for (std::size_t i = 1; i < table.rows.size(); ++i) {
    const double before = table.rows[i - 1].value[column], here = table.rows[i].value[column];
    if (here > before) continue;
    report_row(document, table, table.rows[i], fmt::format("`{}` must increase from row to row: {:g} after {:g}", name, here, before));
    return false;
  }
  return true;
}

}  // namespace hawser
