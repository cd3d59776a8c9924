// The subcommands: each adds itself to the command line and leaves what to run.
#pragma once

#include <CLI/CLI.hpp>
#include <functional>

namespace app {

// What the command line exits with.
enum ExitCode { kExitOk = 0, kExitBadInput = 1, kExitUsage = 2, kExitNotClean = 3 };

// Thrown when everything is written, and `check` has found something.
struct NotClean {};

using Run = std::function<void()>;  // throws InputError, UsageError, NotClean

void add_step(CLI::App& app, Run& run);
void add_active_set(CLI::App& app, Run& run);
void add_candidates(CLI::App& app, Run& run);
void add_queries(CLI::App& app, Run& run);
void add_replay(CLI::App& app, Run& run);
void add_demo(CLI::App& app, Run& run);
void add_bench(CLI::App& app, Run& run);
void add_trade(CLI::App& app, Run& run);
void add_plan(CLI::App& app, Run& run);
void add_check(CLI::App& app, Run& run);

}  // namespace app
