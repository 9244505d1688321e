#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <iostream>
#include <string>
#include <vector>

#include "apps/common/failure.h"
#include "paper_figures/page.h"
#include "paper_figures/run.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/io/write_file.h"

namespace stackabilization::figures {
namespace {

using namespace apps;  // exit statuses

constexpr const char* program_name = "paper_figures";

struct CommandLine {
  RunOptions run;
  bool all = false, list = false;
  std::string output, page, paper_data;
  std::string inputs = STACKABILIZATION_SOURCE_DIR "/paper_figures";
  std::string models = STACKABILIZATION_SOURCE_DIR "/data/models";
};

void add_options(CLI::App& program, CommandLine& line) {
  program.add_option("--figure", line.run.figures, "Make this figure; may be given several times")
      ->type_name("N");
  program.add_flag("--all", line.all, "Make all figures");
  program.add_flag("--list", line.list, "Say which figures there are, and exit");
  program.add_option("-o,--output", line.output, "Folder for pictures and numbers, made where it is missing")
      ->type_name("FOLDER");
  program.add_option("--paper-data", line.paper_data, "Use the authors' models in this folder")
      ->type_name("FOLDER");
  program
      .add_option("--page", line.page, "Write the page about all figures in the output folder, as Markdown")
      ->type_name("FILE");
  program.add_option("--inputs", line.inputs, "Folder of figure_01.json and so on")->type_name("FOLDER");
  program.add_option("--models", line.models, "Folder of this project's models")->type_name("FOLDER");
  program.footer(
      "Example:\n  paper_figures --figure 5 -o out/figures\n  paper_figures --all -o out/figures --page "
      "out/figures/figures.md\n\nExit status: 0 done; 1 a figure was made but a claim does not hold; 2 wrong "
      "usage or\nan output that cannot be written; 3 unusable input.");
}

void check(const CommandLine& line) {
  const bool makes = line.all || !line.run.figures.empty();
  if (line.all && !line.run.figures.empty()) throw UsageError("--all and --figure exclude each other");
  if (!makes && !line.list && line.page.empty())
    throw UsageError("expected one of --figure, --all, --list or --page; none was given");
  if (!line.list && line.output.empty())
    throw UsageError("-o, the folder for pictures and numbers, is missing");
}

int list_figures() {
  for (const Figure& figure : all_figures()) std::cout << figure.number << "  " << figure.title << '\n';
  return status_done;
}

int run(CommandLine& line) {
  check(line);
  if (line.list) return list_figures();
  line.run.inputs = line.inputs;
  line.run.models = line.models;
  line.run.output = line.output;
  if (!line.paper_data.empty()) line.run.paper_data = line.paper_data;
  check_outputs(line.run, line.page);
  RunReport report;
  if (line.all || !line.run.figures.empty()) report = make_figures(line.run, std::cout);
  for (const std::string& failure : report.failures) complain(program_name, failure, status_input);
  if (!line.page.empty())
    write_file_atomically(line.page, figures_page({line.inputs, line.output, line.page}));
  if (!report.failures.empty()) return status_input;
  return report.broken_claims > 0 ? status_no : status_done;
}

int guarded(int argc, char** argv) {
  CommandLine line;
  CLI::App program("Make the figures of the paper, from this project's models or the authors'.",
                   program_name);
  add_options(program, line);
  try {
    program.parse(argc, argv);
    return run(line);
  } catch (const CLI::Success& help) {
    return program.exit(help);
  } catch (...) {
    return complain_of_exception(program_name);
  }
}

}  // namespace
}  // namespace stackabilization::figures

int main(int argc, char** argv) {
  return stackabilization::figures::guarded(argc, argv);
}
