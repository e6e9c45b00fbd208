// A panel: consecutive elements of a line that are worked on together, and their left nodes; the last panel of a line also has its end node.
#pragma once

namespace hawser {

inline constexpr int panel_elements = 64;

/// Panels of a line of so many nodes.
constexpr int panel_count(int nodes) { return nodes > 1 ? (nodes - 2) / panel_elements + 1 : 1; }

constexpr int first_node_of_panel(int panel) { return panel * panel_elements; }

constexpr int nodes_of_panel(int panel, int nodes) { return panel + 1 < panel_count(nodes) ? panel_elements : nodes - first_node_of_panel(panel); }

}  // namespace hawser
