#include <benchmark/benchmark.h>

#include "estimator_operations.h"

/// Prints the microseconds that each operation takes, as Google Benchmark measures them.
int main(int argc, char** argv) {
  for (const reckon::bench::Operation& operation : reckon::bench::AllOperations()) {
    benchmark::RegisterBenchmark(operation.name.data(), [&operation](benchmark::State& state) {
      reckon::bench::EstimatorOperations operations(operation.feet);
      for ([[maybe_unused]] auto _ : state) {
        (operations.*operation.run)();
        benchmark::ClobberMemory();
      }
    })->Unit(benchmark::kMicrosecond);
  }
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
