// gnuplot as a child process.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace hawser {

/// Runs `gnuplot script` in `folder`. Empty where it went well, else what went wrong.
std::string run_gnuplot(const std::filesystem::path& folder, const std::string& script);

/// 'text' with quotes doubled, as gnuplot wants it.
std::string gnuplot_quoted(const std::string& text);

/// The colour of a line of the scene, the same in all pictures; as gnuplot wants it after `rgb`, without quotes.
const char* colour_of(std::size_t line);

/// The head of every script: terminal, output ../NAME.png, fonts, grid, title.
std::string gnuplot_head(const std::string& picture, const std::string& title);

}  // namespace hawser
