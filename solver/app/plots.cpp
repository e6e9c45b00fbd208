#include "solver/app/plots.hpp"

#include <fmt/core.h>
#include <fmt/ostream.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <limits>

#include "solver/app/plots_gnuplot.hpp"

namespace hawser {
namespace fs = std::filesystem;
namespace {

struct Box {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity()), high = -low;

  double extent(int axis) const { return high[axis] - low[axis]; }
  double largest() const { return (high - low).maxCoeff(); }
};

Box box_of(const std::vector<Shape>& shapes) {
  Box box;
  for (const Shape& shape : shapes) {
    for (const auto& line : shape.lines) {
      for (const Vec3& r : line) box.low = box.low.cwiseMin(r), box.high = box.high.cwiseMax(r);
    }
  }
  return box;
}

/// shapes.dat: one gnuplot index a shape and line (index = shape * lines + line); points.dat: the ends of the lines.
void write_shapes(const fs::path& folder, const PlotData& data) {
  std::ofstream out(folder / "shapes.dat");
  fmt::print(out, "# s[m] x[m] y[m] z[m]\n");
  for (const Shape& shape : data.shapes) {
    for (std::size_t i = 0; i < shape.lines.size(); ++i) {
      fmt::print(out, "# t = {} s, line {}\n", shape.time, data.model.lines[i].name);
      for (std::size_t node = 0; node < shape.lines[i].size(); ++node) {
        const Vec3& r = shape.lines[i][node];
        fmt::print(out, "{} {} {} {}\n", data.model.lines[i].s[node], r.x(), r.y(), r.z());
      }
      fmt::print(out, "\n\n");
    }
  }
  std::ofstream points(folder / "points.dat");
  fmt::print(points, "# x[m] y[m] z[m] name, at the time of the first shape\n");
  std::vector<int> done;
  for (std::size_t i = 0; i < data.model.lines.size(); ++i) {
    const Line& line = data.model.lines[i];
    const std::array<std::pair<int, Vec3>, 2> ends{
        {{line.from, data.shapes.front().lines[i].front()}, {line.to, data.shapes.front().lines[i].back()}}};
    for (const auto& [point, r] : ends) {
      if (std::find(done.begin(), done.end(), point) != done.end()) continue;
      done.push_back(point);
      fmt::print(points, "{} {} {} \"{}\"\n", r.x(), r.y(), r.z(), data.model.points[static_cast<std::size_t>(point)].name);
    }
  }
}

/// Axes of a panel whose room is `room` times as wide as high: equal scales unless they would leave most of it empty.
std::string shape_axes(const Box& box, int across, int up, double room) {
  static constexpr std::array<char, 3> names{'x', 'y', 'z'};
  const double width = box.extent(across), height = box.extent(up);
  const bool equal = width > 0.4 * room * height && width < 4.0 * room * height;
  // Room for the names of the points; a line without extent across still gets a frame.
  const double margin_across = 0.16 * std::max(width, 0.05 * height), margin_up = 0.07 * std::max(height, 0.05 * width);
  return fmt::format("set xlabel '{} [m]'\nset ylabel '{} [m]{}'\nset xrange [{}:{}]\nset yrange [{}:{}]\nset size {}\n", names[across], names[up],
                     equal ? "" : "  (not to the scale of the other axis)", box.low[across] - margin_across, box.high[across] + margin_across,
                     box.low[up] - margin_up, box.high[up] + margin_up, equal ? "ratio -1" : "noratio");
}

/// One panel: the shapes in the plane of two axes (0 x, 1 y, 2 z), first shape dark, last red, the others faded.
std::string shape_panel(const PlotData& data, const Box& box, int across, int up, double room) {
  std::string text = shape_axes(box, across, up, room);
  const std::size_t lines = data.model.lines.size(), last = data.shapes.size() - 1;
  text += "plot ";
  const auto add = [&](std::size_t shape, const char* style) {
    for (std::size_t line = 0; line < lines; ++line) {
      text += fmt::format("'shapes.dat' index {} using {}:{} with lines {} notitle, \\\n     ", shape * lines + line, across + 2, up + 2, style);
    }
  };
  const auto explain = [&](std::size_t shape, const char* style) {
    text += fmt::format("keyentry with lines {} title 't = {:.4g} s', \\\n     ", style, data.shapes[shape].time);
  };
  constexpr const char *first_style = "linewidth 2.5 linecolor rgb '#1f3f66'", *last_style = "linewidth 2.5 linecolor rgb '#c8501e'";
  constexpr const char* between_style = "linewidth 1 linecolor rgb '#9db4cc'";
  for (std::size_t shape = 1; shape < last; ++shape) add(shape, between_style);
  if (last > 0) add(last, last_style);
  add(0, first_style);
  explain(0, first_style);
  if (last > 1) text += fmt::format("keyentry with lines {} title 'between', \\\n     ", between_style);
  if (last > 0) explain(last, last_style);
  text += fmt::format("'points.dat' using {}:{} with points pointtype 7 pointsize 1.1 linecolor rgb '#222222' notitle, \\\n", across + 1, up + 1);
  text += fmt::format("     '' using {}:{}:4 with labels left offset 0.8,0.6 noenhanced notitle\n", across + 1, up + 1);
  return text;
}

std::string profile_script(const PlotData& data) {
  const Box box = box_of(data.shapes);
  const double small = 1e-3 * box.largest();
  std::string text = gnuplot_head("profile", data.title);
  if (!data.in_time) text += "unset key\n";
  constexpr double whole = 1.6, half = 0.75;  // width over height of the room for one panel and for two
  if (box.extent(1) <= small) return text + shape_panel(data, box, 0, 2, whole);
  if (box.extent(0) <= small) return text + shape_panel(data, box, 1, 2, whole);
  text += fmt::format("unset title\nset multiplot layout 1,2 title {} noenhanced font 'Sans,18'\n", gnuplot_quoted(data.title));
  text += shape_panel(data, box, 0, 2, half) + shape_panel(data, box, 0, 1, half) + "unset multiplot\n";
  return text;
}

void write_tensions(const fs::path& folder, const PlotData& data) {
  std::ofstream out(folder / "tension.dat");
  fmt::print(out, "# both ends of every element: s[m] least[N] mean[N] greatest[N]\n");
  for (std::size_t i = 0; i < data.ranges.size(); ++i) {
    const TensionRange& range = data.ranges[i];
    const std::vector<double> mean = range.mean();
    fmt::print(out, "# line {}\n", data.model.lines[i].name);
    for (std::size_t k = 0; k < range.s.size(); ++k) fmt::print(out, "{} {} {} {}\n", range.s[k], range.low[k], mean[k], range.high[k]);
    fmt::print(out, "\n\n");
  }
}

std::string tension_script(const PlotData& data) {
  std::string text = gnuplot_head("tension", data.title);
  text += "set xlabel 'unstretched arc length from the first end [m]'\nset ylabel 'effective tension [kN]'\n";
  text += "set style fill transparent solid 0.18 noborder\nplot ";
  const auto add = [&](std::size_t line, const char* columns, const char* style, const std::string& title) {
    text += fmt::format("'tension.dat' index {} using {} with {} linecolor rgb '{}' title {} noenhanced, \\\n     ", line, columns, style,
                        colour_of(line), gnuplot_quoted(title));
  };
  for (std::size_t i = 0; data.in_time && i < data.ranges.size(); ++i) {
    add(i, "1:($2/1e3):($4/1e3)", "filledcurves", data.model.lines[i].name + ", least to greatest");
    add(i, "1:($4/1e3)", "lines linewidth 1", "");
    add(i, "1:($2/1e3)", "lines linewidth 1", "");
  }
  for (std::size_t i = 0; i < data.ranges.size(); ++i) {
    const std::string& name = data.model.lines[i].name;
    add(i, "1:($3/1e3)", "lines linewidth 2.5", data.in_time ? name + ", mean in time" : name);
  }
  return text.substr(0, text.rfind(',')) + '\n';
}

std::string history_script(const PlotData& data) {
  std::string text = gnuplot_head("tension_history", data.title);
  text += "set datafile separator ','\nset datafile columnheaders\nset xlabel 'time [s]'\nset ylabel 'effective tension [kN]'\nplot ";
  for (std::size_t i = 0; i < data.model.lines.size(); ++i) {
    const Line& line = data.model.lines[i];
    const auto add = [&](const char* end, int point, const char* dash) {
      text += fmt::format(
          "'../series.csv' using (column(\"time\")):(column(\"{}.tension_{}\")/1e3) with lines linewidth 2 {} linecolor rgb '{}' title {} "
          "noenhanced, \\\n     ",
          line.name, end, dash, colour_of(i), gnuplot_quoted(line.name + " at " + data.model.points[static_cast<std::size_t>(point)].name));
    };
    add("from", line.from, "dashtype 1");
    add("to", line.to, "dashtype '-'");
  }
  return text.substr(0, text.rfind(',')) + '\n';
}

}  // namespace

PlotReport draw_plots(const fs::path& folder, const PlotData& data) {
  PlotReport report;
  const fs::path plots = folder / "plots";
  fs::create_directories(plots);
  const auto draw = [&](const std::string& name, const std::string& script) {
    std::ofstream(plots / (name + ".gp")) << script;
    const std::string trouble = run_gnuplot(plots, name + ".gp");
    if (trouble.empty()) {
      report.pictures.push_back(folder / (name + ".png"));
    } else {
      report.trouble = trouble;
    }
  };
  write_shapes(plots, data);
  draw("profile", profile_script(data));
  const bool recorded = std::all_of(data.ranges.begin(), data.ranges.end(), [](const TensionRange& range) { return range.count > 0; });
  if (!recorded) return report;
  write_tensions(plots, data);
  draw("tension", tension_script(data));
  if (data.in_time) draw("tension_history", history_script(data));
  return report;
}

}  // namespace hawser
