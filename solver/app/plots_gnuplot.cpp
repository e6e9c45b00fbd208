#include "solver/app/plots_gnuplot.hpp"

#include <fcntl.h>
#include <fmt/core.h>
#include <spawn.h>
#include <sys/wait.h>

#include <array>
#include <cstring>

extern char** environ;

namespace hawser {

std::string run_gnuplot(const std::filesystem::path& folder, const std::string& script) {
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addchdir_np(&actions, folder.c_str());
  posix_spawn_file_actions_addopen(&actions, 1, "/dev/null", O_WRONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 2, "gnuplot.log", O_WRONLY | O_CREAT | O_TRUNC, 0644);
  std::string program = "gnuplot", file = script;
  char* arguments[] = {program.data(), file.data(), nullptr};
  pid_t child = 0;
  const int refused = posix_spawnp(&child, "gnuplot", &actions, nullptr, arguments, environ);
  posix_spawn_file_actions_destroy(&actions);
  if (refused != 0) return fmt::format("gnuplot cannot be started ({}); install it and run it on the .gp files", std::strerror(refused));
  int status = 0;
  waitpid(child, &status, 0);
  if (WIFEXITED(status) && WEXITSTATUS(status) == 0) return {};
  return fmt::format("gnuplot failed on {}: see {}", (folder / script).string(), (folder / "gnuplot.log").string());
}

std::string gnuplot_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("''") : std::string(1, c == '\n' ? ' ' : c);
  return quoted + '\'';
}

const char* colour_of(std::size_t line) {
  static constexpr std::array<const char*, 6> colours{"#1f5f99", "#c8501e", "#2c8a57", "#8a4fa3", "#8c6d1f", "#4a4a4a"};
  return colours[line % colours.size()];
}

std::string gnuplot_head(const std::string& picture, const std::string& title) {
  return fmt::format(
      "set encoding utf8\n"
      "set terminal pngcairo size 1200,800 font 'Sans,15' background rgb 'white'\n"
      "set output '../{}.png'\n"
      "set title {} noenhanced font 'Sans,18'\n"
      "set grid linecolor rgb '#dddddd' linetype 1 linewidth 1\n"
      "set border linecolor rgb '#444444'\n"
      "set tics textcolor rgb '#222222' nomirror\n"
      "set key outside bottom center horizontal reverse Left samplen 3 width 1 height 1.5\n",
      picture, gnuplot_quoted(title));
}

}  // namespace hawser
