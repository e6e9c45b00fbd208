// The body of a sweep; included by one sweep_*.cpp per instruction set, which fixes the pack width. See sweep.hpp.
#pragma once

#include "assembly/pack.hpp"
#include "assembly/sweep.hpp"

namespace hawser {

inline constexpr int panel_nodes = panel_elements + 1 + table_padding;

/// Node vectors of a panel, one row per component: consecutive nodes become consecutive lanes.
template <int B>
struct PanelState {
  alignas(64) double x[3][B][panel_nodes];  // q, v, a

  HAWSER_INLINE void gather(const SweepLine& line, int first, int nodes) {
    const double* source[3] = {line.q, line.v, line.a};
    for (int k = 0; k < 3; ++k)
      for (int i = 0; i < nodes; ++i)
        for (int c = 0; c < B; ++c) x[k][c][i] = source[k][B * (first + i) + c];
    // Lanes beyond the panel repeat its last node shifted by one: finite numbers that nobody reads.
    for (int k = 0; k < 3; ++k)
      for (int c = 0; c < B; ++c)
        for (int i = nodes; i < nodes + table_padding; ++i) x[k][c][i] = x[k][c][nodes - 1] + (k == 0 && c < 3 ? double(i) : 0.0);
  }

  template <int W>
  HAWSER_INLINE Nodal<Pack<W>> nodal(int k, int i) const {
    using S = Pack<W>;
    Nodal<S> n;
    for (int c = 0; c < 3; ++c) {
      n.r0[c] = S::load(&x[k][c][i]);
      n.r1[c] = S::load(&x[k][c][i + 1]);
      if constexpr (B == 6) {
        n.s0[c] = S::load(&x[k][c + 3][i]);
        n.s1[c] = S::load(&x[k][c + 3][i + 1]);
      }
    }
    return n;
  }
};

template <int W>
HAWSER_INLINE Properties<Pack<W>> load_properties(const SweepLine& line, int e) {
  using S = Pack<W>;
  const auto at = [&](int k) __attribute__((always_inline)) { return S::load(line.property[k] + e); };
  return {at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7), at(8), at(9), at(10)};
}

/// Axial terms at the nodes of a panel: force on r' and its block, one row per component.
struct NodalAxial {
  alignas(64) double f[3][panel_nodes], K[9][panel_nodes];

  template <Want want, int W>
  HAWSER_INLINE void compute(const SweepLine& line, const PanelState<6>& state, int first, int nodes) {
    using S = Pack<W>;
    for (int i = 0; i < nodes; i += W) {
      V3<S> slope, rate, force;
      for (int c = 0; c < 3; ++c) {
        slope[c] = S::load(&state.x[0][c + 3][i]);
        rate[c] = S::load(&state.x[1][c + 3][i]);
      }
      Properties<S> e{};
      e.EA = S::load(line.node_property[0] + first + i);
      e.axial_damping = S::load(line.node_property[1] + first + i);
      e.least_tension = S::load(line.node_property[2] + first + i);
      M3<S> block;
      axial_at_node<want>(slope, rate, e, S(1.0), line.weights, force, block);
      for (int c = 0; c < 3; ++c) force[c].store(&f[c][i]);
      if constexpr (want == Want::tangent)
        for (int c = 0; c < 9; ++c) block.m[c].store(&K[c][i]);
    }
  }
};

/// Results of W elements, turned from lanes into blocks: t[row][lane], blocks column-major.
template <int B, int W>
struct PackResult {
  alignas(64) double f[2][B][W];
  alignas(64) double K[2][2][B * B][W];

  template <Want want, class Shape>
  HAWSER_INLINE void store(const ElementResult<Shape, Pack<W>>& r) {
    constexpr int n = B / 3;  // vectors a node
    for (int end = 0; end < 2; ++end)
      for (int i = 0; i < n; ++i)
        for (int c = 0; c < 3; ++c) r.f[n * end + i][c].store(f[end][3 * i + c]);
    if constexpr (want == Want::tangent)
      for (int ea = 0; ea < 2; ++ea)
        for (int eb = 0; eb < 2; ++eb)
          for (int i = 0; i < n; ++i)
            for (int j = 0; j < n; ++j)
              for (int c = 0; c < 9; ++c) r.K[n * ea + i][n * eb + j].m[c].store(K[ea][eb][3 * i + c % 3 + B * (3 * j + c / 3)]);
  }
};

/// What the element before a node adds to it.
template <int B>
struct Running {
  double f[B], K[B * B];
};

template <Want want, int B>
HAWSER_INLINE void write_node(const SweepLine& line, int node, const double* f, const double* K, const Running<B>& before, const NodalAxial& axial,
                              int local) {
  double* r = line.r + B * node;
  for (int c = 0; c < B; ++c) r[c] = f[c] + before.f[c];
  if constexpr (B == 6)
    for (int c = 0; c < 3; ++c) r[3 + c] += axial.f[c][local];
  if constexpr (want == Want::tangent) {
    double* D = line.blocks + 3 * B * B * static_cast<long>(node);
    for (int c = 0; c < B * B; ++c) D[c] = K[c] + before.K[c];
    if constexpr (B == 6)
      for (int c = 0; c < 9; ++c) D[3 + c % 3 + 6 * (3 + c / 3)] += axial.K[c][local];
  }
}

template <class Family, Want want, int W>
void sweep_panel(const SweepLine& line, int panel) {
  using S = Pack<W>;
  using Shape = typename Family::Shape;
  constexpr int B = 3 * Shape::node_vectors;
  const int first = panel * panel_elements;
  const int count = line.elements - first < panel_elements ? line.elements - first : panel_elements;
  PanelState<B> state;
  state.gather(line, first, count + 1);
  NodalAxial axial;
  if constexpr (B == 6) axial.compute<want, W>(line, state, first, count + 1);
  Running<B> before{};
  PackResult<B, W> pack;
  double f[B], K[B * B] = {};
  for (int e = 0; e < count; e += W) {
    const ElementState<S> x{state.template nodal<W>(0, e), state.template nodal<W>(1, e), state.template nodal<W>(2, e)};
    ElementResult<Shape, S> result;
    interior<Family, want>(x, load_properties<W>(line, first + e), line.weights, line.current, result);
    pack.template store<want>(result);
    const int lanes = count - e < W ? count - e : W;
    for (int k = 0; k < lanes; ++k) {
      for (int c = 0; c < B; ++c) f[c] = pack.f[0][c][k];
      if constexpr (want == Want::tangent)
        for (int c = 0; c < B * B; ++c) K[c] = pack.K[0][0][c][k];
      write_node<want, B>(line, first + e + k, f, K, before, axial, e + k);
      for (int c = 0; c < B; ++c) before.f[c] = pack.f[1][c][k];
      if constexpr (want == Want::tangent) {
        double* U = line.blocks + 3 * B * B * static_cast<long>(first + e + k) + B * B;
        for (int c = 0; c < B * B; ++c) U[c] = pack.K[0][1][c][k];
        for (int c = 0; c < B * B; ++c) U[B * B + c] = pack.K[1][0][c][k];
        for (int c = 0; c < B * B; ++c) before.K[c] = pack.K[1][1][c][k];
      }
    }
  }
  if (first + count == line.elements) {
    const Running<B> nothing{};
    write_node<want, B>(line, line.elements, before.f, before.K, nothing, axial, count);
  } else {
    double* carry = line.carry + static_cast<long>(panel) * carry_size;
    for (int c = 0; c < B; ++c) carry[c] = before.f[c];
    if constexpr (want == Want::tangent)
      for (int c = 0; c < B * B; ++c) carry[B + c] = before.K[c];
  }
}

template <int W>
constexpr SweepTable make_sweep_table(const char* name) {
  return {name,
          W,
          {sweep_panel<BarDry, Want::force, W>, sweep_panel<BarWet, Want::force, W>, sweep_panel<CableDry, Want::force, W>,
           sweep_panel<CableWet, Want::force, W>, sweep_panel<BeamDry, Want::force, W>, sweep_panel<BeamWet, Want::force, W>},
          {sweep_panel<BarDry, Want::tangent, W>, sweep_panel<BarWet, Want::tangent, W>, sweep_panel<CableDry, Want::tangent, W>,
           sweep_panel<CableWet, Want::tangent, W>, sweep_panel<BeamDry, Want::tangent, W>, sweep_panel<BeamWet, Want::tangent, W>}};
}

}  // namespace hawser
