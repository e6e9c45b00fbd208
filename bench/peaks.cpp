// What the machine can do, for the roofs of roofline.png: one thread, per instruction set.
//
//   hawser_bench --benchmark_filter=machine
//
// machine/peak/SET          flops: chains of independent multiply-adds in registers (two operations each; SSE2 has no fused ones)
// machine/bandwidth/KIB     bytes: the triad a = b + s c over a working set that fits the first, second, third level or none;
//                           24 bytes an entry as STREAM counts them, the line that a write fetches first not counted
// The loops are this file's own for every width, so that the compiler's vectorizer has no say.
#include <benchmark/benchmark.h>

#include <string>

#include "bench/machine.hpp"

namespace {

using namespace hawser::bench;

#define HAWSER_LOOP __attribute__((always_inline)) inline

template <int W>
struct VectorOf {
  typedef double Type __attribute__((vector_size(8 * W)));
  typedef double InMemory __attribute__((vector_size(8 * W), aligned(8), may_alias));
};

constexpr int accumulators = 12, rounds = 1000;

template <int W>
HAWSER_LOOP void multiply_add(double* out) {
  using Vector = typename VectorOf<W>::Type;
  Vector x[accumulators], factor = Vector{} + 0.999, summand = Vector{} + 1e-3;
  asm volatile("" : "+m"(factor), "+m"(summand));
  for (int k = 0; k < accumulators; ++k) x[k] = Vector{} + 1.0 * k;
  for (int i = 0; i < rounds; ++i) {
#pragma GCC unroll 12
    for (int k = 0; k < accumulators; ++k) x[k] = x[k] * factor + summand;
  }
  Vector sum{};
  for (int k = 0; k < accumulators; ++k) sum += x[k];
  for (int k = 0; k < W; ++k) out[k] = sum[k];
}

/// n is a multiple of 4 W.
template <int W>
HAWSER_LOOP void triad(double* a, const double* b, const double* c, double s, std::size_t n) {
  using InMemory = typename VectorOf<W>::InMemory;
  using Vector = typename VectorOf<W>::Type;
  const auto at = [](const double* p) __attribute__((always_inline))->const InMemory& { return *reinterpret_cast<const InMemory*>(p); };
  for (std::size_t i = 0; i < n; i += 4 * W) {
#pragma GCC unroll 4
    for (std::size_t k = 0; k < 4 * W; k += W) *reinterpret_cast<InMemory*>(a + i + k) = Vector(at(b + i + k)) + s * Vector(at(c + i + k));
  }
}

void multiply_add_base(double* out) { multiply_add<2>(out); }
void triad_base(double* a, const double* b, const double* c, double s, std::size_t n) { triad<2>(a, b, c, s, n); }

#if defined(__x86_64__)
#define HAWSER_AVX2 __attribute__((target("avx2,fma")))
#define HAWSER_AVX512 __attribute__((target("avx512f,avx512dq,avx512vl,fma,prefer-vector-width=512")))
HAWSER_AVX2 void multiply_add_avx2(double* out) { multiply_add<4>(out); }
HAWSER_AVX512 void multiply_add_avx512(double* out) { multiply_add<8>(out); }
HAWSER_AVX2 void triad_avx2(double* a, const double* b, const double* c, double s, std::size_t n) { triad<4>(a, b, c, s, n); }
HAWSER_AVX512 void triad_avx512(double* a, const double* b, const double* c, double s, std::size_t n) { triad<8>(a, b, c, s, n); }
#endif

struct Loops {
  int width;
  void (*multiply_add)(double*);
  void (*triad)(double*, const double*, const double*, double, std::size_t);
};

Loops loops_of(std::string_view set) {
#if defined(__x86_64__)
  if (set == "avx512") return {8, multiply_add_avx512, triad_avx512};
  if (set == "avx2") return {4, multiply_add_avx2, triad_avx2};
#endif
  return {2, multiply_add_base, triad_base};
}

benchmark::Counter rate(double amount) { return benchmark::Counter(amount, benchmark::Counter::kIsIterationInvariantRate); }

void peak(benchmark::State& state, std::string_view set) {
  const Loops loops = loops_of(set);
  double out[8] = {};
  for (auto _ : state) {
    loops.multiply_add(out);
    benchmark::DoNotOptimize(out);
  }
  state.counters["flops_per_second"] = rate(2.0 * accumulators * rounds * loops.width);
}

void bandwidth(benchmark::State& state, std::string_view set) {
  const Loops loops = loops_of(set);
  const std::size_t n = static_cast<std::size_t>(state.range(0)) * 1024 / 24 / 32 * 32;
  std::vector<double> a(n, 1.0), b(n, 2.0), c(n, 3.0);
  for (auto _ : state) {
    loops.triad(a.data(), b.data(), c.data(), 0.5, n);
    benchmark::ClobberMemory();
  }
  state.counters["bytes_per_second"] = rate(24.0 * static_cast<double>(n));
}

const bool registered = [] {
  for (const std::string_view set : instruction_sets()) benchmark::RegisterBenchmark(("machine/peak/" + std::string(set)).c_str(), peak, set);
  auto* triads = benchmark::RegisterBenchmark("machine/bandwidth", bandwidth, instruction_sets().back());
  for (const long kib : {16L, 512L, 8192L, 524288L}) triads->Arg(kib);
  return true;
}();

}  // namespace
