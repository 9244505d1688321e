#pragma once

#include <CLI/CLI.hpp>
#include <filesystem>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include "common/hash.h"
#include "common/models.h"
#include "common/plot.h"
#include "common/sheet.h"
#include "common/table.h"

namespace stackabilization::experiments {

/// What an experiment found: tables, plots, sheets of designs, and what went wrong.
class Report {
 public:
  /// The table of this name, "" being the main one; made at its first mention.
  Table& table(const std::string& name, const std::vector<Column>& columns);
  void plot(const std::string& name, Plot plot) { plots_[name] = {std::move(plot)}; }
  /// Several in one picture.
  void plots(const std::string& name, std::vector<Plot> plots) { plots_[name] = std::move(plots); }
  void sheet(const std::string& name, Sheet sheet) { sheets_.insert_or_assign(name, std::move(sheet)); }

  /// One input could not be used; the others go on. The sentence goes to standard error at once.
  void failed(const std::string& sentence);
  /// The experiment ran, but its answer is no.
  void deny() { denied_ = true; }

 private:
  friend class Experiment;
  std::map<std::string, Table> tables_;
  std::map<std::string, std::vector<Plot>> plots_;
  std::map<std::string, Sheet> sheets_;
  std::string program_;
  bool failed_ = false, denied_ = false;
};

/// Which inputs an experiment is about.
enum class Inputs {
  none,    ///< it makes its own
  models,  ///< MODEL..., by default all shipped ones, and those of --paper-data
};

enum class Threads {
  any,  ///< --threads, by default all
  one,  ///< a program that measures what one thread does
};

/// The command line, the outputs and the exit status of a program that answers one question. Options -o,
/// --threads, MODEL and --paper-data are here; a program adds its own. With `-o FOLDER` each table becomes
/// FOLDER/PROGRAM[_TABLE].csv and .json without clocks, and .clocks.csv with them; each plot an .svg or
/// .png, each sheet a .png (when pictures are built). Without -o the main table goes to standard output,
/// clocks included.
///
/// Exit status 0: done; 1: the answer is no; 2: wrong usage, or outputs cannot be written; 3: an input cannot
/// be used (rows of the others are written).
class Experiment {
 public:
  Experiment(std::string program, const std::string& question, Inputs inputs = Inputs::models,
             Threads threads = Threads::any);

  /// For options of the program itself; their defaults are recorded too.
  CLI::App& app() { return app_; }

  /// Instead of all, of the shipped models only these, by name, unless others are asked for.
  void use_by_default(std::vector<std::string> names);

  /// The models asked for, after the command line was read. Throws InputError when a folder is missing.
  std::vector<ModelFile> models() const;
  /// Empty unless --paper-data is given.
  const std::filesystem::path& paper_data() const { return paper_data_; }
  int threads() const { return threads_; }

  /// Reads the command line, runs `body` with that many threads and writes what it reports. To be called
  /// once.
  int run(int argc, char** argv, const std::function<void(Report&)>& body);

 private:
  int guarded(const std::function<void(Report&)>& body);
  void prepare_output() const;
  void write(const Report& report) const;
  Provenance provenance() const;

  std::string program_, plot_format_ = "svg";
  CLI::App app_;
  std::vector<std::string> files_, default_models_;
  std::filesystem::path output_, paper_data_;
  bool takes_models_;
  int threads_ = 1;
};

/// Calls `measure` with every model, its shape and the hash of its file. A model that cannot be used is
/// reported as failed and the next one follows.
void for_each_model(const std::vector<ModelFile>& models, Report& report,
                    const std::function<void(const ModelFile&, const Shape&, const std::string&)>& measure);

}  // namespace stackabilization::experiments
