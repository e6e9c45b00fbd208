// mesh: nodes of a line from its sections and loads (architecture rule 8).
//
// Every section change and every concentrated load gets a node; a section's elements are shared among the pieces between
// its loads in proportion to their length (at least one each), so a load that falls on a node of the even mesh keeps it.
#pragma once

#include <span>
#include <string>
#include <vector>

#include "assembly/model.hpp"
#include "assembly/scene.hpp"

namespace hawser {

/// Throws std::invalid_argument where there is none: the reader has refused such a scene.
const LineType& find_type(const std::string& name, std::span<const LineType> types);

struct MeshJoint {
  int node;
  Jump jump;
};

struct LineMesh {
  Family family;
  std::vector<double> s;              // arc length of each node [m]
  std::vector<const LineType*> type;  // of each element
  std::vector<MeshJoint> joints;      // where the slope jumps
};

LineMesh mesh_line(const LineSpec& line, std::span<const LineType> types);

/// The part of an even load over [s0, s1] that falls on one element: xi in [xi0, xi1], share of the whole.
struct Spread {
  int element;
  double xi0, xi1, share;
};
std::vector<Spread> spread_over(std::span<const double> nodes, double s0, double s1);

int nearest_node(std::span<const double> nodes, double s);

}  // namespace hawser
