#pragma once

namespace reckon::harness {

/// Exit codes of the program. Interrupted follows the shells' convention (128 + SIGINT).
enum ExitCode : int {
  kExitHolds = 0,
  kExitExpectationFailed = 1,
  kExitBadInput = 2,
  kExitRunFailed = 3,
  kExitSkipped = 77,
  kExitInterrupted = 130,
};

/// The program `reckon`: parses the command line, does what it says and returns the exit code.
/// Results go to stdout, everything else to stderr.
int RunCommandLine(int argc, char** argv);

}  // namespace reckon::harness
