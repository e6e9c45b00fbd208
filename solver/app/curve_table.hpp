// CurveTable: the rows of `static --vary` in both spellings, CSV and JSON (README.md says what their columns mean).
#pragma once

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "assembly/observables.hpp"
#include "solver/app/plots_curve.hpp"
#include "solver/app/recorder_series.hpp"
#include "solver/curve.hpp"

namespace hawser {

/// What a row says before the columns of the model.
struct CurveRow {
  double value = 0.0;   // of the key, in its unit
  std::string setting;  // the override that gives it
  bool converged = false, stable = false, fold = false, bifurcation = false, warm = false;
  int negative_pivots = 0, branch = 0, iterations = 0;
  double residual = 0.0;
};

class CurveTable {
 public:
  /// echo: CSV rows go to stdout too, as they come.
  explicit CurveTable(bool echo) : echo_(echo) {}

  /// A row without an equilibrium takes its columns from the model alone, and says why with `failure`.
  void add(const CurveRow& row, const Model& model, const State& state, const Failure& failure = {});

  const std::string& csv() const { return csv_; }
  const nlohmann::ordered_json& json() const { return json_; }
  CurveParts parts() const { return parts_; }

 private:
  struct Column;
  static std::vector<Column> columns_of(const Model& model, const Observation& observation);
  void write_header(const std::vector<Column>& columns);
  void write(const std::string& line);

  bool echo_;
  CurveParts parts_;
  std::string csv_;
  nlohmann::ordered_json json_ = nlohmann::ordered_json::array();
};

}  // namespace hawser
