#include <cstdio>
#include <cstdlib>

#include "estimator_operations.h"

/// Repeats one of the operations, for a tool that counts instructions:
///     <program> <place in the table> <repetitions>
/// Without arguments it prints their names, a line each.
int main(int argc, char** argv) {
  const auto& all = reckon::bench::AllOperations();
  if (argc != 3) {
    for (const auto& operation : all) std::puts(operation.name.data());
    return argc == 1 ? EXIT_SUCCESS : EXIT_FAILURE;
  }
  const auto& operation = all.at(std::strtoul(argv[1], nullptr, 10));
  reckon::bench::EstimatorOperations operations(operation.feet);
  for (long i = std::strtol(argv[2], nullptr, 10); i > 0; --i) (operations.*operation.run)();
  return EXIT_SUCCESS;
}
