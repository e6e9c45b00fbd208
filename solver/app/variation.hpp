// KEY=a:b:n: n evenly spaced values of one key of the scene, from a to b. Each value is an override as --set takes it.
//
// The key is spelled as for --set: list items by number, points.top.position.0. a and b are bare numbers (SI, degrees), or
// both carry the same unit: "environment.depth=1 km:2 km:11".
#pragma once

#include <string>

namespace hawser {

struct Variation {
  std::string key;
  std::string unit;  // as written; empty: that of a bare number
  double first = 0.0, last = 0.0;
  int count = 0;

  /// Value number i of 0 to count - 1, in the unit; between whole numbers those between.
  double value(double i) const;

  /// The override that sets it, "key=value".
  std::string override_at(double i) const;
};

/// Throws InputError that names the option and says what is wrong with its argument.
Variation parse_variation(const std::string& option, const std::string& text);

}  // namespace hawser
