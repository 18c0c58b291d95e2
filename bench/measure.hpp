// How the benchmarks measure: in yardsticks, medians over cases.
#pragma once

#include <benchmark/benchmark.h>

#include <Eigen/Cholesky>
#include <algorithm>
#include <chrono>
#include <limits>
#include <random>
#include <vector>

namespace poise {

/// Seconds that one call takes, from as many calls as fill a few microseconds.
template <class Call>
double seconds(const Call& call, int calls) {
  const auto start = std::chrono::steady_clock::now();
  for (int k = 0; k < calls; ++k) call();
  return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count() / calls;
}

inline double quantile(std::vector<double> values, double part) {
  const auto at =
      values.begin() + static_cast<std::ptrdiff_t>(part * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}
inline double median(std::vector<double> values) { return quantile(std::move(values), 0.5); }

/// Seconds for one Eigen fixed-size N x N LDLT factor-and-solve.
template <int N>
double yardstick(std::mt19937& random) {
  std::uniform_real_distribution<> uniform(-1, 1);
  const Eigen::Matrix<double, N, 2 * N> A = Eigen::Matrix<double, N, 2 * N>::NullaryExpr(
      [&](Eigen::Index, Eigen::Index) { return uniform(random); });
  Eigen::Matrix<double, N, N> M = A * A.transpose();
  Eigen::Matrix<double, N, 1> b = A.col(0);
  return seconds(
      [&] {
        benchmark::DoNotOptimize(M.data());
        benchmark::ClobberMemory();
        const Eigen::Matrix<double, N, 1> x = M.ldlt().solve(b);
        benchmark::DoNotOptimize(x.data());
        benchmark::ClobberMemory();
      },
      100);
}

inline double mean(const std::vector<double>& values) {
  double sum = 0;
  for (const double value : values) sum += value;
  return sum / static_cast<double>(values.size());
}

/// Times call(i) for case after case, a yardstick of N x N after each.
template <int N, class Call>
void measure(benchmark::State& state, std::size_t cases, int calls, const Call& call,
             int repeats = 1) {
  std::mt19937 random(1);
  std::vector<double> times, yardsticks;
  for (auto _ : state) {
    const std::size_t i = times.size() % cases;
    // The least of some: what interrupts one of them would show in the mean.
    double least = std::numeric_limits<double>::infinity();
    for (int k = 0; k < repeats; ++k) least = std::min(least, seconds([&] { call(i); }, calls));
    times.push_back(least);
    state.SetIterationTime(least);
    yardsticks.push_back(yardstick<N>(random));
  }
  state.counters["median_ns"] = 1e9 * median(times);
  state.counters["yardstick_ns"] = 1e9 * median(yardsticks);
  state.counters["yardsticks"] = median(times) / median(yardsticks);
  if (repeats > 1) state.counters["mean_by_median"] = mean(times) / median(times);
  state.counters["p95"] = quantile(times, 0.95) / median(yardsticks);
}

}  // namespace poise
