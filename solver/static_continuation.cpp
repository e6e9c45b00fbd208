#include "solver/static_continuation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/norms.hpp"

namespace hawser {
namespace {

constexpr double first_bending = 1e-3;     // EI_a over W L^2: bends over a tenth of the length
constexpr double last_bending = 1e-4;      // over w l^3: bends over a twentieth of an element
constexpr double first_stiffness = 100.0;  // EA_a over W
constexpr double least_stiffness = 30.0;   // EA over EI/l^2: a softer one would rather stretch than bend
constexpr double first_ratio = 0.1;
constexpr int most_failures = 8;

}  // namespace

StaticContinuation::StaticContinuation(const Model& real, double load)
    : real_(real), relaxed_(real), stiffest_(*std::max_element(real.element.EA.begin(), real.element.EA.end())), ratio_(first_ratio) {
  const double L = longest_line(real), l = *std::min_element(real.element.length.begin(), real.element.length.end());
  bool bars = true;
  for (Line& line : relaxed_.lines) {
    bars = bars && line.family == Family::bar;
    if (line.family == Family::cable) line.family = Family::beam;
  }
  here_.EI = bars ? 0.0 : first_bending * load * L * L;
  here_.EA = first_stiffness * load;
  before_ = here_;
  least_EI_ = last_bending * load / L * l * l * l;
  apply();
}

std::string StaticContinuation::place() const { return fmt::format("EI >= {:.2g} N m2, EA <= {:.2g} N", here_.EI, here_.EA); }

void StaticContinuation::advance() {
  before_ = here_;
  ++steps_;
  if (here_.EI > 0.0)
    here_.EI = here_.EI > least_EI_ ? ratio_ * here_.EI : 0.0;
  else
    here_.EA = std::min(here_.EA / ratio_, stiffest_);
  ratio_ = std::max(first_ratio, ratio_ * std::sqrt(ratio_));
  apply();
}

bool StaticContinuation::retreat() {
  const bool to_none = here_.EI == 0.0 && before_.EI > 0.0;
  here_ = before_;
  if (to_none) least_EI_ *= first_ratio;
  ratio_ = std::pow(ratio_, to_none ? 1.0 : 1.0 / 3.0);
  apply();
  return ++failures_ <= most_failures;
}

void StaticContinuation::apply() {
  if (here_.EI <= *std::min_element(real_.element.EI.begin(), real_.element.EI.end())) here_.EI = 0.0;
  for (std::size_t e = 0; e < real_.element.EA.size(); ++e) {
    const double l = real_.element.length[e], EI = std::max(here_.EI, real_.element.EI[e]);
    relaxed_.element.EI[e] = EI;
    relaxed_.element.EA[e] = std::min(std::max(here_.EA, least_stiffness * EI / (l * l)), real_.element.EA[e]);
  }
}

}  // namespace hawser
