// A root of a continuous function of one variable between two points where its signs differ.
#pragma once

#include <algorithm>
#include <cmath>

namespace hawser {

/// Regula falsi with the Illinois correction and a bisection now and then; ends with the root inside an interval of `resolution`.
template <class Function>
double bracketed_root(Function f, double a, double b, double fa, double fb, double resolution) {
  constexpr int most = 200, bisect_every = 4;
  double last = 0.0;  // value at the point before: the same sign twice means that the other end stands still
  for (int i = 1; i < most && b - a > resolution; ++i) {
    double x = i % bisect_every == 0 ? 0.5 * (a + b) : (a * fb - b * fa) / (fb - fa);
    // Never closer to an end than half the resolution: from the last step on the root lies between the two newest points.
    x = std::clamp(x, a + 0.5 * resolution, b - 0.5 * resolution);
    const double fx = f(x);
    if (fx == 0.0) return x;
    if ((fx > 0.0) == (fb > 0.0)) {
      b = x, fb = fx;
      if (last * fx > 0.0) fa *= 0.5;
    } else {
      a = x, fa = fx;
      if (last * fx > 0.0) fb *= 0.5;
    }
    last = fx;
  }
  return 0.5 * (a + b);
}

}  // namespace hawser
