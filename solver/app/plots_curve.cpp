#include "solver/app/plots_curve.hpp"

#include <fmt/format.h>

#include <fstream>

#include "solver/app/plots_gnuplot.hpp"

namespace hawser {
namespace {

std::string curve_script(const std::string& title, const std::string& abscissa, const Model& model) {
  std::string text = gnuplot_head("curve", title);
  text += fmt::format(
      "set datafile separator ','\nset datafile columnheaders\nset xlabel {} noenhanced\nset ylabel 'effective tension [kN]'\n"
      "set offsets graph 0, graph 0, graph 0.05, graph 0.05\nplot ",
      gnuplot_quoted(abscissa));
  for (std::size_t i = 0; i < model.lines.size(); ++i) {
    const Line& line = model.lines[i];
    const auto add = [&](const char* end, int point, const char* dash) {
      text += fmt::format(
          "'../curve.csv' using (column(\"value\")):(column(\"{}.tension_{}\")/1e3) with linespoints linewidth 2 {} pointtype 7 pointsize 0.8 "
          "linecolor rgb '{}' title {} noenhanced, \\\n     ",
          line.name, end, dash, colour_of(i), gnuplot_quoted(line.name + " at " + model.points[static_cast<std::size_t>(point)].name));
    };
    add("from", line.from, "dashtype 1");
    add("to", line.to, "dashtype '-'");
  }
  return text.substr(0, text.rfind(',')) + '\n';
}

}  // namespace

std::string draw_curve(const std::filesystem::path& folder, const std::string& title, const std::string& abscissa, const Model& model) {
  std::filesystem::create_directories(folder / "plots");
  std::ofstream(folder / "plots" / "curve.gp") << curve_script(title, abscissa, model);
  return run_gnuplot(folder / "plots", "curve.gp");
}

}  // namespace hawser
