// The house rules that a machine can check: includes point one way, third-party headers stay in one place each,
// every folder is documented, no file outgrows five screens.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <regex>
#include <string>
#include <vector>

namespace hawser {
namespace {

namespace fs = std::filesystem;

const fs::path root = HAWSER_SOURCE_DIR;

/// Every file below `folder`, as a path relative to the root.
std::vector<fs::path> files_below(const std::string& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(root / folder))
    if (entry.is_regular_file()) files.push_back(fs::relative(entry.path(), root));
  return files;
}

/// The C++ sources of the product: what tests include is their own affair.
std::vector<fs::path> product_sources() {
  std::vector<fs::path> sources;
  for (const char* room : {"assembly", "solver", "bench"})
    for (const fs::path& file : files_below(room))
      if (file.extension() == ".hpp" || file.extension() == ".cpp") sources.push_back(file);
  return sources;
}

std::vector<std::string> lines_of(const fs::path& file) {
  std::ifstream stream(root / file);
  std::vector<std::string> lines;
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::vector<std::string> includes_of(const fs::path& file) {
  static const std::regex include(R"(\s*#\s*include\s*["<]([^">]+)[">].*)");
  std::vector<std::string> headers;
  for (const std::string& line : lines_of(file))
    if (std::smatch match; std::regex_match(line, match, include)) headers.push_back(match[1]);
  return headers;
}

/// Headers matching `header` may be included only by files matching `place`.
struct IncludeRule {
  const char* name;
  const char* header;
  const char* place;
};

void PrintTo(const IncludeRule& rule, std::ostream* out) { *out << rule.place; }

const IncludeRule rules[] = {
    {"OnlySolverAndBenchSeeTheSolver", R"(solver/.*)", R"((solver|bench)/.*)"},
    {"OnlyTheProgramAndBenchSeeTheProgram", R"(solver/app/.*)", R"((solver/app|bench)/.*)"},
    {"NothingSeesBench", R"((bench|benchmark)/.*)", R"(bench/.*)"},
    {"NothingSeesTests", R"((tests|gtest|gmock|rapidcheck)[/.].*)", R"(tests/.*)"},
    {"NothingClimbsOutOfItsFolder", R"(\.\./.*)", R"()"},
    {"SuiteSparseOnlyInLinear", R"((suitesparse/.*|(cholmod|umfpack|klu|amd|btf|colamd|SuiteSparse).*\.h))", R"(solver/linear/.*)"},
    {"LapackOnlyInLinear", R"((lapacke|cblas|lapack).*\.h)", R"(solver/linear/.*)"},
    {"Hdf5OnlyInTheRecorder", R"((hdf5/.*|hdf5.*\.h|H5.*\.h))", R"(solver/app/recorder.*)"},
    {"TomlOnlyInTheSceneReader", R"(toml\+\+.*)", R"(solver/app/toml_.*)"},
    {"SundialsOnlyInItsFolder", R"((sundials|nvector|sunlinsol|sunmatrix|sunnonlinsol|ida|idas|kinsol|cvode)/.*)",
     R"((solver/sundials/.*|bench/sundials_.*))"},
};

class IncludeDirection : public testing::TestWithParam<IncludeRule> {};

TEST_P(IncludeDirection, Holds) {
  const std::regex header(GetParam().header), place(GetParam().place);
  for (const fs::path& file : product_sources())
    for (const std::string& included : includes_of(file))
      EXPECT_TRUE(!std::regex_match(included, header) || std::regex_match(file.generic_string(), place))
          << file << " includes " << included << ", which belongs only in " << GetParam().place;
}

INSTANTIATE_TEST_SUITE_P(Architecture, IncludeDirection, testing::ValuesIn(rules), [](const auto& rule) { return std::string(rule.param.name); });

TEST(Architecture, IncludesAreFound) {
  const std::vector<std::string> headers = includes_of("assembly/assembler.hpp");
  EXPECT_EQ(std::count(headers.begin(), headers.end(), "assembly/model.hpp"), 1);
  EXPECT_EQ(std::count(headers.begin(), headers.end(), "vector"), 1);
}

TEST(Architecture, EveryFolderHasAReadme) {
  EXPECT_TRUE(fs::exists(root / "README.md"));
  for (const char* room : {"assembly", "solver", "bench", "tests", "data"}) {
    EXPECT_TRUE(fs::exists(root / room / "README.md")) << room;
    for (const auto& entry : fs::recursive_directory_iterator(root / room)) {
      const bool documented = !entry.is_directory() || fs::exists(entry.path() / "README.md");
      EXPECT_TRUE(documented) << fs::relative(entry.path(), root);
    }
  }
}

TEST(Architecture, NoSourceFileIsLongerThanFiveScreens) {
  for (const fs::path& file : product_sources()) EXPECT_LE(lines_of(file).size(), 400u) << file;
}

TEST(Architecture, NoUnfinishedMarkIsLeftInTheSources) {
  const std::regex mark(R"(.*\b(TODO|FIXME|XXX|HACK)\b.*)");
  for (const fs::path& file : product_sources())
    for (const std::string& line : lines_of(file)) EXPECT_FALSE(std::regex_match(line, mark)) << file << ": " << line;
}

}  // namespace
}  // namespace hawser
