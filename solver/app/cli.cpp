#include "solver/app/cli.hpp"

#include <fmt/core.h>

#include <CLI/CLI.hpp>
#include <array>
#include <filesystem>
#include <thread>

#include "solver/app/command_check.hpp"
#include "solver/app/command_run.hpp"
#include "solver/app/command_static.hpp"
#include "solver/app/scene_reader.hpp"
#include "solver/app/text.hpp"

namespace hawser {
namespace {

constexpr const char* program_example =
    "  hawser check  data/scenes/umbilical-heave.toml\n"
    "  hawser static data/scenes/catenary-5000.toml\n"
    "  hawser run    data/scenes/umbilical-heave.toml --out heave";
constexpr const char* program_description =
    "hawser computes how long marine cables hang, tow and shake.\n"
    "Exit codes: 0 done, 1 internal error, 2 usage or input, 3 no static equilibrium, 4 the time integration stopped, "
    "5 a curve finished with failed values, 130 interrupted.";
constexpr const char* check_example = "  hawser check scene.toml";
constexpr const char* static_example =
    "  hawser static scene.toml --set environment.water_density=1000 --json\n"
    "  hawser static scene.toml --vary points.top.position.0=0:500:11 --out offsets";
constexpr const char* run_example = "  hawser run scene.toml --out results";

/// Help that starts with the example, kept as the footer of a command.
class ExampleFirst : public CLI::Formatter {
  std::string make_description(const CLI::App* app) const override {
    const std::string example = app->get_footer().empty() ? "" : "Example:\n" + app->get_footer() + "\n\n";
    return example + CLI::Formatter::make_description(app);
  }
  std::string make_footer(const CLI::App*) const override { return {}; }
};

/// Commands and options that are spelled in the documentation but do nothing yet: known by name, refused.
constexpr std::array<const char*, 5> unbuilt_commands{"modes", "sweep", "chart", "report", "convert"};

void refuse_unbuilt(const std::string& name) { throw InputError(fmt::format("{} is not built yet", name)); }

void add_common(CLI::App& command, Request& request) {
  command.add_option("SCENE", request.scene, "scene file (TOML)")->required();
  command.add_option("--set", request.overrides, "override a key of the scene, for example lines.tether.sections.0.elements=500; repeatable")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
  command.add_flag("--json", request.json, "print one JSON document on stdout");
  command.add_flag("--quiet,-q", request.quiet, "no progress and no talk; warnings and errors remain");
  command.add_option("--threads", request.threads, "threads; 0: all")->check(CLI::NonNegativeNumber)->type_name("N");
}

void add_static(CLI::App& command, Request& request) {
  auto* start =
      command
          .add_option_function<std::string>(
              "--start", [&request](const std::string& name) { request.start = name == "straight" ? StaticStart::straight : StaticStart::catenary; },
              "first guess: catenary (default) or straight")
          ->check(CLI::IsMember({"catenary", "straight"}).description(""))
          ->type_name("NAME");
  command.add_option("--from", request.from, "first guess: the last state of a result on the same mesh")->type_name("FILE")->excludes(start);
  auto* stations = command.add_option("--stations", request.stations, "even stations in the JSON document (default: the nodes)")
                       ->check(CLI::Range(2, 10'000'000))
                       ->type_name("N");
  auto* probe = command.add_option("--probe", request.probe, "solve from N perturbed starts too and list the distinct equilibria")
                    ->check(CLI::Range(1, 1'000'000))
                    ->type_name("N");
  auto* vary =
      command
          .add_option("--vary", request.vary, "the equilibria of n values of one key from a to b, spelled as for --set: CSV rows, or a JSON array")
          ->type_name("KEY=a:b:n")
          ->excludes(stations)
          ->excludes(probe);
  command.add_option("--out", request.out, "folder for static.json, result.h5 and pictures; with --vary: curve.csv, curve.json, curve.png")
      ->type_name("DIR");
  command
      .add_option_function<std::string>(
          "--method", [&request](const std::string& name) { request.method = name == "kinsol" ? StaticMethod::kinsol : StaticMethod::newton; },
          "newton (default), or kinsol: SUNDIALS from the same starts, with the same certificate")
      ->check(CLI::IsMember({"newton", "kinsol"}).description(""))
      ->type_name("NAME")
      ->excludes(vary);
}

int dispatch(int argc, const char* const* argv) {
  Request request;
  CLI::App app{program_description, "hawser"};
  app.formatter(std::make_shared<ExampleFirst>());
  app.footer(program_example);
  app.set_version_flag("--version", std::string("hawser ") + HAWSER_VERSION);
  app.require_subcommand(1);
  int code = static_cast<int>(ExitCode::done);
  const auto add_command = [&](const char* name, const char* help, const char* example, int (*run)(const Request&)) {
    CLI::App* command = app.add_subcommand(name, help);
    command->footer(example);
    add_common(*command, request);
    command->callback([&code, &request, run] { code = run(request); });
    return command;
  };
  add_command("check", "say what was understood of a scene and what it will cost; solve nothing", check_example, command_check);
  add_static(*add_command("static", "compute the static equilibrium", static_example, command_static), request);
  add_command("run", "compute the equilibrium, then the motion; write a folder of results and pictures", run_example, command_run)
      ->add_option("--out", request.out, "folder for the results (default: SCENE.out in the current folder)")
      ->type_name("DIR");
  for (const char* name : unbuilt_commands) {
    app.add_subcommand(name, "not built yet")->allow_extras()->callback([name] { refuse_unbuilt(fmt::format("hawser {}", name)); });
  }
  try {
    app.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app.exit(error) == 0 ? static_cast<int>(ExitCode::done) : static_cast<int>(ExitCode::usage);
  }
  return code;
}

}  // namespace

Scene read_request(const Request& request, std::vector<Diagnostic>* warnings) {
  Scene scene = read_scene(request.scene, request.overrides, warnings);
  if (scene.title.empty()) scene.title = std::filesystem::path(scene.path).stem().string();
  if (request.threads) scene.solve.threads = *request.threads;
  if (scene.solve.threads == 0) scene.solve.threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  return scene;
}

Model build_requested_model(const Scene& scene) {
  try {
    return build_model(scene);
  } catch (const std::invalid_argument& error) {
    throw InputError(fmt::format("{}: {}", scene.path, error.what()));
  }
}

void say_failure(const Failure& failure) {
  say_error(failure.what);
  if (!failure.line.empty()) fmt::print(stderr, "  where   line {}, s = {:.6g} m\n", failure.line, failure.s);
  if (!failure.stage.empty()) fmt::print(stderr, "  stage   {}\n", failure.stage);
  if (!failure.cause.empty()) fmt::print(stderr, "  cause   {}\n", failure.cause);
  if (!failure.remedy.empty()) fmt::print(stderr, "  remedy  {}\n", failure.remedy);
  if (!failure.kept.empty()) fmt::print(stderr, "  kept    {}\n", failure.kept);
}

int run_program(int argc, const char* const* argv) {
  try {
    return dispatch(argc, argv);
  } catch (const InputError& error) {
    fmt::print(stderr, "{}", error.what());
    return static_cast<int>(ExitCode::usage);
  } catch (const std::exception& error) {
    say_error(fmt::format("internal: {}", error.what()));
    return static_cast<int>(ExitCode::internal);
  }
}

}  // namespace hawser
