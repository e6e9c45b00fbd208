#include "solver/app/plots_curve.hpp"

#include <fmt/format.h>

#include <fstream>

#include "solver/app/plots_gnuplot.hpp"

namespace hawser {
namespace {

/// One end of a line over the rows of branch b that satisfy `which`.
std::string curve_of(const Line& line, const char* end, CurveParts parts, const char* which) {
  return fmt::format(
      "for [b=1:{}] '../curve.csv' using (column(\"branch\")==b && ({}) ? column(\"value\") : NaN):(column(\"{}.tension_{}\")/1e3) with linespoints",
      parts.branches, which, line.name, end);
}

std::string curve_script(const std::string& title, const std::string& abscissa, const Model& model, CurveParts parts) {
  std::string text = gnuplot_head("curve", title);
  text += fmt::format(
      "set datafile separator ','\nset datafile columnheaders\nset xlabel {} noenhanced\nset ylabel 'effective tension [kN]'\n"
      "set offsets graph 0, graph 0, graph 0.05, graph 0.05\nplot ",
      gnuplot_quoted(abscissa));
  for (std::size_t i = 0; i < model.lines.size(); ++i) {
    const Line& line = model.lines[i];
    const auto add = [&](const char* end, int point, const char* dash) {
      const std::string name = gnuplot_quoted(line.name + " at " + model.points[static_cast<std::size_t>(point)].name);
      text += fmt::format("{} linewidth 2 {} pointtype 7 pointsize 0.8 linecolor rgb '{}' title (b==1 ? {} : '') noenhanced, \\\n     ",
                          curve_of(line, end, parts, "column(\"stable\")==1 || column(\"fold\")==1 || column(\"bifurcation\")==1"), dash,
                          colour_of(i), name);
      if (!parts.unstable) return;
      text += fmt::format("{} linewidth 1 dashtype '.' pointtype 6 pointsize 0.8 linecolor rgb '{}' title (b==1 ? {} : '') noenhanced, \\\n     ",
                          curve_of(line, end, parts, "column(\"stable\")==0"), colour_of(i), gnuplot_quoted("unstable"));
    };
    add("from", line.from, "dashtype 1");
    add("to", line.to, "dashtype '-'");
  }
  return text.substr(0, text.rfind(", \\\n")) + '\n';
}

}  // namespace

std::string draw_curve(const std::filesystem::path& folder, const std::string& title, const std::string& abscissa, const Model& model,
                       CurveParts parts) {
  std::filesystem::create_directories(folder / "plots");
  std::ofstream(folder / "plots" / "curve.gp") << curve_script(title, abscissa, model, parts);
  return run_gnuplot(folder / "plots", "curve.gp");
}

}  // namespace hawser
