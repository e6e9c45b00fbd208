// ReferenceCase: one file of data/reference, an independent solution with its source and the tolerance it allows.
#pragma once

#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>

#include "assembly/scene.hpp"

namespace hawser::test {

class ReferenceCase {
 public:
  explicit ReferenceCase(const std::string& name) {
    std::ifstream file(std::string(HAWSER_SOURCE_DIR) + "/data/reference/" + name + ".json");
    if (!file) throw std::runtime_error("no reference case " + name);
    file >> json_;
  }

  const nlohmann::json& parameter(const std::string& key) const { return json_.at("parameters").at(key); }

  const nlohmann::json& quantity(const std::string& name) const {
    for (const auto& q : json_.at("quantities"))
      if (q.at("name") == name) return q;
    throw std::runtime_error("no quantity " + name);
  }

  template <class T = double>
  T value(const std::string& name) const {
    return quantity(name).at("value").get<T>();
  }

  /// What the file asks of a converged solver, absolute, for a value of this size.
  double tolerance(const std::string& name, double size) const {
    const auto& q = quantity(name);
    return q.contains("tolerance_absolute") ? q["tolerance_absolute"].get<double>() : q["tolerance_relative"].get<double>() * std::abs(size);
  }

 private:
  nlohmann::json json_;
};

using Table = std::vector<std::vector<double>>;

inline Vec3 vector(const nlohmann::json& j) { return {j.at(0).get<double>(), j.at(1).get<double>(), j.at(2).get<double>()}; }

}  // namespace hawser::test
