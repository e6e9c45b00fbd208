// The command line: what was asked for, and the one way from it to a command.
//
// Exit codes: 0 done, 1 internal error, 2 usage or input, 3 no static equilibrium, 4 the time integration stopped,
// 5 a curve finished with failed values, 130 interrupted. Data go to stdout, talk goes to stderr.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "solver/app/diagnostics.hpp"
#include "solver/statics.hpp"

namespace hawser {

enum class ExitCode { done = 0, internal = 1, usage = 2, no_equilibrium = 3, integration_stopped = 4, failed_cases = 5, interrupted = 130 };

enum class StaticMethod { newton, kinsol };

struct Request {
  std::string scene;                   // path
  std::vector<std::string> overrides;  // "key=value"
  bool json = false, quiet = false;
  std::optional<int> threads;  // absent: as the scene says; 0: all
  std::string out;             // folder; empty: the command's default
  StaticStart start = StaticStart::catenary;
  std::string from;  // result file to start a static from
  int stations = 0;  // even stations; 0: the nodes
  int probe = 0;     // perturbed starts of a static; 0: none
  StaticMethod method = StaticMethod::newton;
  std::string vary;  // KEY=a:b:n of a static; empty: one equilibrium
};

/// The scene with its overrides, with the number of threads to use in solve.threads (never 0), and the name of the file where it has no title.
/// Warnings go to stderr, or to `warnings` where given. Throws InputError.
Scene read_request(const Request& request, std::vector<Diagnostic>* warnings = nullptr);

/// build_model, with a scene it refuses reported as InputError.
Model build_requested_model(const Scene& scene);

/// Says on stderr where and why a solve stopped and what to try.
void say_failure(const Failure& failure);

/// The whole program: parses, runs the command, turns exceptions into messages and exit codes.
int run_program(int argc, const char* const* argv);

}  // namespace hawser
