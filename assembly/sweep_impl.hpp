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
    const double* source[3] = {line.q + B * first, line.v + B * first, line.a + B * first};
    const int whole = B == 6 ? nodes / 4 * 4 : 0;
    for (int k = 0; k < 3; ++k) {
      if constexpr (B == 6)
        for (int i = 0; i < whole; i += 4) gather_four(source[k] + B * i, &x[k][0][i]);
      for (int i = whole; i < nodes; ++i)
        for (int c = 0; c < B; ++c) x[k][c][i] = source[k][B * i + c];
    }
    // Lanes beyond the panel repeat its last node shifted by one: finite numbers that nobody reads.
    for (int k = 0; k < 3; ++k)
      for (int c = 0; c < B; ++c)
        for (int i = nodes; i < nodes + table_padding; ++i) x[k][c][i] = x[k][c][nodes - 1] + (k == 0 && c < 3 ? double(i) : 0.0);
  }

  /// Six rows of four nodes.
  HAWSER_INLINE static void gather_four(const double* from, double* to) {
#if defined(__AVX__)
    copy_transposed<4>(from, 6, to, panel_nodes);
#else
    for (int part : {0, 2}) {
      copy_transposed<2>(from + 6 * part, 6, to + part, panel_nodes);
      copy_transposed<2>(from + 6 * part + 2, 6, to + 2 * panel_nodes + part, panel_nodes);
    }
#endif
    for (int part : {0, 2}) copy_transposed<2>(from + 6 * part + 4, 6, to + 4 * panel_nodes + part, panel_nodes);
  }

  template <int W>
  HAWSER_INLINE V3<Pack<W>> vector(int k, int row, int i) const {
    using S = Pack<W>;
    return {{S::load(&x[k][row][i]), S::load(&x[k][row + 1][i]), S::load(&x[k][row + 2][i])}};
  }
  template <int W>
  HAWSER_INLINE Nodal<Pack<W>> nodal(int k, int i) const {
    if constexpr (B == 6)
      return {vector<W>(k, 0, i), vector<W>(k, 3, i), vector<W>(k, 0, i + 1), vector<W>(k, 3, i + 1)};
    else
      return {vector<W>(k, 0, i), {}, vector<W>(k, 0, i + 1), {}};
  }
};

template <int W>
HAWSER_INLINE Properties<Pack<W>> load_properties(const SweepLine& line, int e) {
  using S = Pack<W>;
  const auto at = [&](int k) __attribute__((always_inline)) { return S::load(line.property[k] + e); };
  return {at(0), at(1), at(2), at(3), at(4), at(5), at(6), at(7), at(8), at(9), at(10)};
}

/// The rows of the current that a panel reaches: its elements stay within the control points of their curves, r -+ (l/3) r'.
template <int B, int W>
HAWSER_INLINE CurrentTable current_around(const SweepLine& line, const PanelState<B>& state, int count) {
  using S = Pack<W>;
  if (line.current.rows < 3) return line.current;
  S longest(0.0), low(1e300), high(-1e300);
  for (int i = 0; i < count; i += W) longest = maximum(longest, S::load(line.property[0] + i));
  double third = 0.0;
  for (int lane = 0; lane < W; ++lane) third = longest.v[lane] / 3.0 > third ? longest.v[lane] / 3.0 : third;
  for (int i = 0; i <= count; i += W) {
    const S z = S::load(&state.x[0][2][i]);
    const S reach = B == 6 ? S(third) * magnitude(S::load(&state.x[0][B - 1][i])) : S(0.0);
    low = minimum(low, z - reach);
    high = maximum(high, z + reach);
  }
  double lowest = low.v[0], highest = high.v[0];
  for (int lane = 1; lane < W; ++lane) {
    lowest = low.v[lane] < lowest ? low.v[lane] : lowest;
    highest = high.v[lane] > highest ? high.v[lane] : highest;
  }
  return rows_between(line.current, lowest, highest);
}

/// Axial terms at the nodes of a panel: force on r' and its block, one row per component.
struct NodalAxial {
  alignas(64) double f[3][panel_nodes], K[9][panel_nodes];

  template <Want want, int W>
  HAWSER_INLINE void compute(const SweepLine& line, const PanelState<6>& state, int nodes) {
    using S = Pack<W>;
    for (int i = 0; i < nodes; i += W) {
      V3<S> slope, rate, force;
      for (int c = 0; c < 3; ++c) {
        slope[c] = S::load(&state.x[0][c + 3][i]);
        rate[c] = S::load(&state.x[1][c + 3][i]);
      }
      Properties<S> e{};
      e.EA = S::load(line.node_property[0] + i);
      e.axial_damping = S::load(line.node_property[1] + i);
      e.least_tension = S::load(line.node_property[2] + i);
      M3<S> block;
      Axial::evaluate<want>(slope, rate, e, line.weights, force, block);
      for (int c = 0; c < 3; ++c) force[c].store(&f[c][i]);
      if constexpr (want == Want::tangent)
        for (int c = 0; c < 9; ++c) block.m[c].store(&K[c][i]);
    }
  }
};

/// What the pack before left at its right nodes; only the last lane is read.
template <int B, int W>
struct Running {
  Pack<W> f[B], K[B * B];
};

/// Row of the column-major B x B block for component c of the 3 x 3 block (i, j).
template <int B>
constexpr int block_row(int i, int j, int c) {
  return 3 * i + c % 3 + B * (3 * j + c / 3);
}

/// The nodal values D, U, L of W nodes, lanes = nodes; D gathers both elements of a node and its axial term.
template <class Family, int W>
HAWSER_INLINE void fill_rows(const Integrand<Family, Pack<W>>& in, const NodalAxial& axial, int first,
                             Running<3 * Family::Shape::node_vectors, W>& before, Pack<W>* rows) {
  using S = Pack<W>;
  constexpr int n = Family::Shape::node_vectors, B = 3 * n;
  nodal_tangent(
      in, [&](int c, const S(&K)[2 * n][2 * n]) __attribute__((always_inline)) {
        const int corner = c % 3 + B * (c / 3);
        for (int j = 0; j < n; ++j)
          for (int i = 0; i < n; ++i) {
            const int row = corner + 3 * i + 3 * B * j;
            const S right = K[n + i][n + j];
            S diagonal = K[i][j] + shifted(before.K[row], right);
            if (i == 1 && j == 1) diagonal = diagonal + S::load(&axial.K[c][first]);
            before.K[row] = right;
            rows[row] = diagonal;
            rows[B * B + row] = K[i][n + j];
            rows[2 * B * B + row] = K[n + i][j];
          }
      });
}

/// Writes `count` rows held lane by lane as `lanes` contiguous runs of `count` doubles: four rows at a time, which become 32 bytes of a
/// node. Whole cache lines would straddle the nodes, whose blocks are an odd number of half lines long.
template <int count, int W>
HAWSER_INLINE void store_transposed(const Pack<W>* rows, double* to, int lanes) {
  constexpr int tile = W < 4 ? W : 4, whole = count / tile * tile, pairs = count / 2 * 2;
  const double* from = reinterpret_cast<const double*>(rows);
  if (lanes == W) {
#pragma GCC unroll 1
    for (int t = 0; t < whole; t += tile)
      for (int lane = 0; lane < W; lane += tile) copy_transposed<tile>(from + W * t + lane, W, to + static_cast<long>(count) * lane + t, count);
    for (int t = whole; t < pairs; t += 2)
      for (int lane = 0; lane < W; lane += 2) copy_transposed<2>(from + W * t + lane, W, to + static_cast<long>(count) * lane + t, count);
  }
  for (int t = lanes == W ? pairs : 0; t < count; ++t)
    for (int k = 0; k < lanes; ++k) to[static_cast<long>(count) * k + t] = rows[t].v[k];
}

template <class Shape, int W>
HAWSER_INLINE void write_residual(const V3<Pack<W>>* f, const NodalAxial& axial, int e, int lanes, Running<3 * Shape::node_vectors, W>& before,
                                  double* to) {
  constexpr int n = Shape::node_vectors, B = 3 * n;
  Pack<W> rows[B];
  for (int i = 0; i < n; ++i)
    for (int c = 0; c < 3; ++c) {
      const Pack<W> right = f[n + i][c];
      rows[3 * i + c] = f[i][c] + shifted(before.f[3 * i + c], right);
      if (i == 1) rows[3 * i + c] = rows[3 * i + c] + Pack<W>::load(&axial.f[c][e]);
      before.f[3 * i + c] = right;
    }
  store_transposed<B, W>(rows, to, lanes);
}

/// The end node of a line has no element of its own.
template <Want want, int B, int W>
HAWSER_INLINE void write_end(const SweepLine& line, const Running<B, W>& before, const NodalAxial& axial, int local, int lane) {
  double* r = line.r + static_cast<long>(B) * line.elements;
  for (int c = 0; c < B; ++c) r[c] = before.f[c].v[lane] + (c < 3 ? 0.0 : axial.f[c % 3][local]);
  if constexpr (want == Want::tangent) {
    double* D = line.blocks + 3L * B * B * local;
    for (int c = 0; c < B * B; ++c) D[c] = before.K[c].v[lane];
    if constexpr (B == 6)
      for (int c = 0; c < 9; ++c) D[block_row<6>(1, 1, c)] += axial.K[c][local];
  }
}

/// Asks for what the W elements from e on will need: the tables of a panel are too many short streams for the processor to foresee.
template <int B, int W>
HAWSER_INLINE void fetch_ahead(const SweepLine& line, int first, int local) {
  const int e = first + local + line.next;
  const auto fetch = [](const double* p, int doubles) __attribute__((always_inline)) {
    for (int i = 0; i < doubles; i += 8) __builtin_prefetch(p + i, 0, 2);
  };
  fetch(line.q + B * e, B * W), fetch(line.v + B * e, B * W), fetch(line.a + B * e, B * W);
  for (int i = 0; i < B * W; i += 8) __builtin_prefetch(line.r + B * e + i, 1, 2);
  if (line.next_table == 0) return;
  for (const double* table : line.property) __builtin_prefetch(table + local + line.next_table, 0, 2);
  if constexpr (B == 6)
    for (const double* table : line.node_property) __builtin_prefetch(table + local + line.next_table, 0, 2);
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
  const CurrentTable current = current_around<B, W>(line, state, count);
  NodalAxial axial;
  if constexpr (B == 6) axial.compute<want, W>(line, state, count + 1);
  Running<B, W> before;
  for (S& x : before.f) x = S(0.0);
  if constexpr (want == Want::tangent)
    for (S& x : before.K) x = S(0.0);
  int lanes = W;
  for (int e = 0; e < count; e += W) {
    lanes = count - e < W ? count - e : W;
    if (line.next != 0) fetch_ahead<B, W>(line, first, e);
    const Properties<S> properties = load_properties<W>(line, e);
    const ElementState<S> x{state.template nodal<W>(0, e), state.template nodal<W>(1, e), state.template nodal<W>(2, e)};
    Integrand<Family, S> in;
    integrate<Family, want>(x, properties, line.weights, current, in);
    V3<S> f[2 * Shape::node_vectors];
    nodal_force(in, f);
    write_residual<Shape>(f, axial, e, lanes, before, line.r + static_cast<long>(B) * (first + e));
    if constexpr (want == Want::tangent) {
      S rows[3 * B * B];
      fill_rows(in, axial, e, before, rows);
      store_transposed<3 * B * B, W>(rows, line.blocks + 3L * B * B * e, lanes);
    }
  }
  if (first + count == line.elements) {
    write_end<want, B, W>(line, before, axial, count, lanes - 1);
  } else {
    double* carry = line.carry + static_cast<long>(panel) * carry_size;
    for (int c = 0; c < B; ++c) carry[c] = before.f[c].v[lanes - 1];
    if constexpr (want == Want::tangent)
      for (int c = 0; c < B * B; ++c) carry[B + c] = before.K[c].v[lanes - 1];
  }
}

template <class Family, int W>
void observe_panel(const SweepLine& line, double* rows) {
  using S = Pack<W>;
  using Shape = typename Family::Shape;
  PanelState<3 * Shape::node_vectors> state;
  state.gather(line, 0, line.elements + 1);
  for (int e = 0; e < line.elements; e += W) {
    const ElementState<S> x{state.template nodal<W>(0, e), state.template nodal<W>(1, e), state.template nodal<W>(2, e)};
    const Properties<S> properties = load_properties<W>(line, e);
    Integrand<Family, S> in;
    integrate<Family, Want::force>(x, properties, Weights{1.0, 0.0, 0.0, false}, line.current, in);
    V3<S> f[2 * Shape::node_vectors];
    nodal_force(in, f);
    Observed<S> seen;
    observe<Shape>(x.q, f[0], f[Shape::node_vectors], properties.length, properties.EA, seen);
    const S row[observed_rows] = {seen.tension[0],        seen.tension[1],        seen.curvature[0],     seen.curvature[1],
                                  seen.strain_tension[0], seen.strain_tension[1], seen.strain_tension[2]};
    for (int k = 0; k < observed_rows; ++k) row[k].store(rows + k * observed_stride + e);
  }
}

template <int W>
void copy_negated(const double* from, double* to, std::size_t count) {
  std::size_t i = 0;
  for (; i + W <= count; i += W) (-Pack<W>::load(from + i)).store(to + i);
  for (; i < count; ++i) to[i] = -from[i];
}

template <int W>
constexpr SweepTable make_sweep_table(const char* name) {
  return {name,
          W,
          {sweep_panel<BarDry, Want::force, W>, sweep_panel<BarWet, Want::force, W>, sweep_panel<CableDry, Want::force, W>,
           sweep_panel<CableWet, Want::force, W>, sweep_panel<BeamDry, Want::force, W>, sweep_panel<BeamWet, Want::force, W>},
          {sweep_panel<BarDry, Want::tangent, W>, sweep_panel<BarWet, Want::tangent, W>, sweep_panel<CableDry, Want::tangent, W>,
           sweep_panel<CableWet, Want::tangent, W>, sweep_panel<BeamDry, Want::tangent, W>, sweep_panel<BeamWet, Want::tangent, W>},
          {observe_panel<BarDry, W>, observe_panel<BarWet, W>, observe_panel<CableDry, W>, observe_panel<CableWet, W>, observe_panel<BeamDry, W>,
           observe_panel<BeamWet, W>},
          copy_negated<W>};
}

}  // namespace hawser
