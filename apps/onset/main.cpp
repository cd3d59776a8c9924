// onset: the command line of the library.
#include <CLI/CLI.hpp>
#include <cstdio>
#include <exception>
#include <iostream>
#include <new>
#include <string>

#include "files/error.hpp"
#include "files/interrupts.hpp"
#include "onset/command_line/commands.hpp"

namespace {

// One line on stderr, whatever the cause.
int fail(app::ExitCode code, std::string message) {
  for (char& c : message)
    if (c == '\n') c = ' ';
  std::fprintf(stderr, "onset: %s\n", message.c_str());
  return code;
}

// What --help and --version print may meet a full disk, too.
int print(const CLI::App& app, const CLI::ParseError& e) {
  app.exit(e);
  std::cout.flush();
  return std::cout ? int(app::kExitOk) : fail(app::kExitBadInput, "stdout: cannot be written");
}

// After the subcommands, which would take the examples over.
void describe(CLI::App& app) {
  app.name("onset");
  app.set_version_flag("--version", "onset " ONSET_VERSION);
  app.require_subcommand(0, 1);
  app.footer(
      "Examples:\n"
      "  onset demo                                   a scene of its own, no files needed\n"
      "  onset step before.ply after.ply              how far the motion can go\n"
      "  onset active-set a.obj b.obj --csv -         what touches, one row a pair\n"
      "  onset check before.ply                       whether a step can start there, and what is in the "
      "way\n"
      "  onset queries data/edge-edge/*.csv           answers against their truth\n"
      "  onset step a.obj b.obj --dump slow           the queries that matter, for onset replay slow-*.csv\n"
      "  onset trade before.ply after.ply             what each setting costs and gives, on this scene\n"
      "Exit status: 0 done, whatever the outcome is; 1 bad input, or output that cannot be written; 2 wrong "
      "usage; 3 check has found something.");
}

}  // namespace

int main(int argc, char** argv) {
  app::prepare_process();
  CLI::App app("Conservative continuous collision detection: when does a moving mesh first touch itself?");
  app::Run run;
  app::add_step(app, run);
  app::add_active_set(app, run);
  app::add_candidates(app, run);
  app::add_plan(app, run);
  app::add_check(app, run);
  app::add_queries(app, run);
  app::add_replay(app, run);
  app::add_demo(app, run);
  app::add_bench(app, run);
  app::add_trade(app, run);
  describe(app);
  try {
    app.parse(argc, argv);
    if (!run) throw app::UsageError("a subcommand is required (see onset --help)");
    run();
    return app::kExitOk;
  } catch (const app::NotClean&) {
    return app::kExitNotClean;
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return print(app, e);  // --help, --version
    return fail(app::kExitUsage, std::string(e.what()) + " (see onset --help)");
  } catch (const app::UsageError& e) {
    return fail(app::kExitUsage, e.what());
  } catch (const std::bad_alloc&) {
    return fail(app::kExitBadInput, "not enough memory");
  } catch (const std::exception& e) {
    return fail(app::kExitBadInput, e.what());
  }
}
