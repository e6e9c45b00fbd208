// Facts of the machine and the build, for the head of every JSON file.
#include <benchmark/benchmark.h>

#include <cstdlib>
#include <fstream>
#include <string>

namespace {

std::string processor() {
  std::ifstream file("/proc/cpuinfo");
  for (std::string line; std::getline(file, line);)
    if (line.starts_with("model name")) return line.substr(line.find(':') + 2);
  return "unknown";
}

const char* kernels() {
  const char* forced = std::getenv("HAWSER_SIMD");
  return forced ? forced : "widest of the processor";
}

const bool stated = [] {
  benchmark::AddCustomContext("processor", processor());
  benchmark::AddCustomContext("compiler", __VERSION__);
  benchmark::AddCustomContext("kernels", kernels());
  return true;
}();

}  // namespace
