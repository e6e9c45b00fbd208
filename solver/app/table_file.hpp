// Tables of numbers in CSV files that a scene names: motions, first guesses of a shape, starts.
//
// The first line names the columns; blank lines and lines that begin with # are skipped; numbers are SI, separated by commas.
#pragma once

#include <string>
#include <vector>

#include "solver/app/toml_document.hpp"

namespace hawser {

struct TableFile {
  struct Row {
    int line = 0;               // in the file, from 1
    std::string name;           // of the first column, where that holds names
    std::vector<double> value;  // of the columns with numbers
  };
  std::string path;
  std::vector<Row> rows;
};

enum class FirstColumn { number, name };

/// Reads `file`, relative to the folder of the scene. The header must be exactly `columns`, all values finite. Faults are
/// reported in the document (of the file itself: at `named_at`, the value that names it) and leave no rows.
TableFile read_table_file(Document& document, const toml::node& named_at, const std::string& file, const std::vector<std::string>& columns,
                          FirstColumn first);

/// Reports a fault in a row of such a file.
void report_row(Document& document, const TableFile& table, const TableFile::Row& row, const std::string& message);

/// True where a column increases strictly; else the first row that does not is reported.
bool increases(Document& document, const TableFile& table, std::size_t column, const std::string& name);

}  // namespace hawser
