#pragma once

#include <CLI/App.hpp>
#include <functional>

#include "apps/common/common_options.h"
#include "apps/common/failure.h"

/// The subcommands of `stackabilize`. Each one parses into its options, calls the library and hands the
/// result over as text, JSON, meshes and pictures; nothing is computed here.
namespace stackabilization::apps {

/// A subcommand that knows how to run once the command line is parsed.
struct Command {
  CLI::App* app;
  std::function<int()> run;  ///< returns the exit status; throws the errors of the library
  CommonOptions* common;     ///< lives as long as `run`
};

Command make_inspect_command(CLI::App& program);
Command make_measure_command(CLI::App& program);
Command make_search_command(CLI::App& program);
Command make_map_command(CLI::App& program);
Command make_stack_command(CLI::App& program);
Command make_hold_command(CLI::App& program);
Command make_gap_command(CLI::App& program);
Command make_drop_command(CLI::App& program);
Command make_items_command(CLI::App& program);
Command make_draft_command(CLI::App& program);
Command make_validate_command(CLI::App& program);
Command make_structure_command(CLI::App& program);
Command make_deform_command(CLI::App& program);
Command make_suggest_command(CLI::App& program);
Command make_compare_command(CLI::App& program);
Command make_improve_command(CLI::App& program);
Command make_edit_command(CLI::App& program);

}  // namespace stackabilization::apps
