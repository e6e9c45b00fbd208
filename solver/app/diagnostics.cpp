#include "solver/app/diagnostics.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>

namespace hawser {
namespace {

constexpr std::size_t most_shown = 50;  // a file of noise has thousands of faults of one kind

/// Spaces up to `column`, keeping tabs so that the underline stands below its text.
std::string indent_like(const std::string& source, int column) {
  std::string out;
  int at = 1;
  for (std::size_t i = 0; i < source.size() && at < column; ++i) {
    if ((static_cast<unsigned char>(source[i]) & 0xC0) == 0x80) continue;  // inside a UTF-8 character
    out += source[i] == '\t' ? '\t' : ' ';
    ++at;
  }
  return out;
}

std::string with_source(const Diagnostic& d) {
  const std::string number = d.place.line > 0 ? std::to_string(d.place.line) : "";
  const std::string margin(number.size(), ' ');
  std::string out = fmt::format("{}--> {}", margin.empty() ? " " : margin, d.where);
  if (d.place.line > 0) out += fmt::format(":{}:{}", d.place.line, d.place.column);
  out += '\n';
  if (!d.source.empty()) {
    const std::string carets(std::max(d.width, 1), '^');
    out += fmt::format("{} |\n{} | {}\n{} | {}{}", margin, number, d.source, margin, indent_like(d.source, d.source_column), carets);
    out += d.label.empty() ? "\n" : " " + d.label + "\n";
  } else if (!d.label.empty()) {
    out += fmt::format("{} = {}\n", margin, d.label);
  }
  for (const std::string& note : d.notes) out += fmt::format("{} = {}\n", margin, note);
  return out;
}

std::string render_all(const std::vector<Diagnostic>& diagnostics) {
  std::string out;
  const std::size_t shown = std::min(diagnostics.size(), most_shown);
  for (std::size_t i = 0; i < shown; ++i) out += render(diagnostics[i]) + "\n";
  if (shown < diagnostics.size()) out += fmt::format("... and {} more\n\n", diagnostics.size() - shown);
  const auto errors = std::count_if(diagnostics.begin(), diagnostics.end(), [](const Diagnostic& d) { return d.severity == Severity::error; });
  return out + fmt::format("{} error{}. Nothing was run.\n", errors, errors == 1 ? "" : "s");
}

/// Restricted Damerau-Levenshtein distance.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  std::vector<std::size_t> before(b.size() + 1), previous(b.size() + 1), row(b.size() + 1);
  std::iota(previous.begin(), previous.end(), 0);
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      row[j] = std::min({previous[j] + 1, row[j - 1] + 1, previous[j - 1] + (a[i - 1] != b[j - 1])});
      if (i > 1 && j > 1 && a[i - 1] == b[j - 2] && a[i - 2] == b[j - 1]) row[j] = std::min(row[j], before[j - 2] + 1);
    }
    before.swap(previous);
    previous.swap(row);
  }
  return previous[b.size()];
}

std::string lower_case(std::string_view text) {
  std::string out(text);
  for (char& c : out) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return out;
}

}  // namespace

std::string render(const Diagnostic& d) {
  std::string out = fmt::format("{}: {}\n", d.severity == Severity::error ? "error" : "warning", d.message);
  if (!d.where.empty()) return out + with_source(d);
  for (const std::string& note : d.notes) out += fmt::format("  = {}\n", note);
  return out;
}

InputError::InputError(std::vector<Diagnostic> diagnostics) : std::runtime_error(render_all(diagnostics)), diagnostics_(std::move(diagnostics)) {}

InputError::InputError(const std::string& message) : InputError(std::vector<Diagnostic>{{Severity::error, message, {}, {}, {}, 1, 1, {}, {}}}) {}

std::string nearest(std::string_view word, const std::vector<std::string>& candidates) {
  constexpr std::size_t longest = 64;  // no key or name that long is a slip of the finger
  if (word.empty() || word.size() > longest) return {};
  const std::string wanted = lower_case(word);
  const std::size_t most = word.size() / 3 + 1;  // one edit in a short word, one more every three letters
  std::string best;
  std::pair<std::size_t, std::size_t> best_score{most + 1, 0};  // edits; letters after the common beginning
  for (const std::string& candidate : candidates) {
    if (candidate.size() > longest) continue;
    const std::string name = lower_case(candidate);
    const std::size_t edits = edit_distance(wanted, name);
    const auto common = std::mismatch(wanted.begin(), wanted.end(), name.begin(), name.end()).first - wanted.begin();
    const std::pair score{edits, wanted.size() - static_cast<std::size_t>(common)};
    if (edits <= most && edits < candidate.size() && score < best_score) {
      best = candidate;
      best_score = score;
    }
  }
  return best;
}

std::string did_you_mean(std::string_view word, const std::vector<std::string>& candidates) {
  const std::string best = nearest(word, candidates);
  return best.empty() ? "" : fmt::format("did you mean `{}`?", best);
}

}  // namespace hawser
