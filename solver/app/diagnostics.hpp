// Messages about bad input, in the shape compilers use:
//
//   error: unknown key `curent` in [environment]
//    --> scene.toml:4:1
//     |
//   4 | curent = [[0.0, 0.5, 0.0]]
//     | ^^^^^^ did you mean `current`?
//     = allowed: gravity, water_density, depth, current, seabed
//
// Reading collects Diagnostics and throws one InputError that holds them all. Columns count characters from 1.
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "assembly/scene.hpp"

namespace hawser {

enum class Severity { error, warning };

struct Diagnostic {
  Severity severity = Severity::error;
  std::string message;             // one sentence without a full stop
  std::string where;               // file name, or the command-line option; may be empty
  Place place;                     // line 0: no place within `where`
  std::string source;              // text of that line, or a part of it; may be empty
  int source_column = 1;           // of the place within `source`
  int width = 1;                   // characters to underline
  std::string label;               // beside the underline; may be empty
  std::vector<std::string> notes;  // one line each: what is allowed, what to try
};

/// The printable text of one diagnostic, with a final newline.
std::string render(const Diagnostic&);

/// Everything found wrong with the input, in one exception. what() is the complete text with its final newline.
class InputError : public std::runtime_error {
 public:
  explicit InputError(std::vector<Diagnostic> diagnostics);
  /// One error that has no place in a file, such as a bad combination of options.
  explicit InputError(const std::string& message);

  const std::vector<Diagnostic>& diagnostics() const { return diagnostics_; }

 private:
  std::vector<Diagnostic> diagnostics_;
};

/// The candidate nearest to `word` by edit distance (insert, delete, replace or swap neighbours), empty if none is near.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// "did you mean `X`?" or an empty string.
std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace hawser
