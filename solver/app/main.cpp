// The program hawser: settings of the numerical libraries, then the command line.
#include "solver/app/cli.hpp"
#include "solver/app/environment.hpp"

int main(int argc, char** argv) {
  hawser::settle_environment(argv);
  return hawser::run_program(argc, argv);
}
