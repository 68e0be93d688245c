#include "reckon/harness/cli.h"

int main(int argc, char** argv) { return reckon::harness::RunCommandLine(argc, argv); }
