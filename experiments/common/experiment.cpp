#include "common/experiment.h"

#include <tbb/global_control.h>
#include <tbb/info.h>

#include <algorithm>
#include <iostream>

#include "common/resume.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/utf8.h"
#include "stackabilization/io/file_plan.h"
#include "stackabilization/io/read.h"
#include "stackabilization/io/write_file.h"
#ifdef STACKABILIZATION_WITH_RENDERING
#include "common/plot_drawing.h"
#include "stackabilization/rendering/pictures.h"
#endif

namespace stackabilization::experiments {

namespace fs = std::filesystem;

namespace {

/// Files by their names only: where they lie is different on every machine.
std::string name_of(const std::string& value) {
  const fs::path path = value;
  return path.has_filename() ? path.filename().string() : path.parent_path().filename().string();
}

#ifdef STACKABILIZATION_WITH_RENDERING
Drawing drawing_of(const Sheet& sheet) {
  std::vector<DesignTile> tiles;
  for (const SheetTile& tile : sheet.tiles)
    tiles.push_back({tile.shape, {}, {}, {}, tile.captions, tile.at_rest});
  DesignSheetOptions options;
  options.width = 1000;
  options.title = sheet.title;
  return design_sheet(tiles, sheet.direction, options);
}
#endif

}  // namespace

Table& Report::table(const std::string& name, const std::vector<Column>& columns) {
  return tables_.try_emplace(name, columns).first->second;
}

void Report::failed(const std::string& sentence) {
  failed_ = true;
  std::cerr << program_ << ": " << sentence << "\n";
}

Experiment::Experiment(std::string program, const std::string& question, Inputs inputs, Threads threads)
    : program_(std::move(program)), app_(question, program_), takes_models_(inputs == Inputs::models) {
  app_.option_defaults()->always_capture_default();
  app_.footer("Example: " + program_ + " -o results" + (takes_models_ ? " data/models/cup.obj" : ""));
  app_.add_option("-o,--output", output_,
                  "folder for tables (CSV, JSON) and plots, made when missing; without it the main table "
                  "goes to standard output")
      ->type_name("FOLDER");
#ifdef STACKABILIZATION_WITH_RENDERING
  app_.add_option("--plots", plot_format_, "file format of the plots")->check(CLI::IsMember({"svg", "png"}));
#endif
  if (threads == Threads::any) {
    threads_ = tbb::info::default_concurrency();
    app_.add_option("--threads", threads_, "threads at most")->check(CLI::Range(1, 1024));
  }
  if (!takes_models_) return;
  app_.add_option("models", files_, "mesh files; by default all that this project ships")->type_name("MODEL");
  app_.add_option("--paper-data", paper_data_, "folder of the authors' data; its models are measured too")
      ->type_name("FOLDER");
}

void Experiment::use_by_default(std::vector<std::string> names) {
  default_models_ = std::move(names);
  std::string text = "mesh files; by default of the shipped ones";
  for (std::size_t k = 0; k < default_models_.size(); ++k)
    text += (k == 0 ? " " : k + 1 < default_models_.size() ? ", " : " and ") + default_models_[k];
  app_.get_option("models")->description(text);
}

std::vector<ModelFile> Experiment::models() const {
  std::vector<ModelFile> models;
  for (const std::string& file : files_) models.push_back({file, fs::path(file).stem().string()});
  if (models.empty()) {
    models = shipped_models();
    std::erase_if(models, [&](const ModelFile& model) {
      return !default_models_.empty() &&
             std::find(default_models_.begin(), default_models_.end(), model.name) == default_models_.end();
    });
  }
  if (!paper_data_.empty())
    for (const ModelFile& model : paper_models(paper_data_)) models.push_back(model);
  return models;
}

int Experiment::run(int argc, char** argv, const std::function<void(Report&)>& body) {
  for (int i = 1; i < argc; ++i)
    if (!is_utf8(argv[i])) {
      std::cerr << program_ << ": argument " << i << " is not UTF-8\n";
      return 2;
    }
  try {
    app_.parse(argc, argv);
  } catch (const CLI::ParseError& error) {
    return app_.exit(error) == 0 ? 0 : 2;
  }
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(threads_));
  return guarded(body);
}

int Experiment::guarded(const std::function<void(Report&)>& body) {
  const auto complain = [&](const std::exception& error, int status) {
    std::cerr << program_ << ": " << error.what() << "\n";
    return status;
  };
  try {
    prepare_output();
    Report report;
    report.program_ = program_;
    body(report);
    const auto main_table = report.tables_.find("");
    const bool nothing = main_table != report.tables_.end() && main_table->second.rows().empty();
    if (!report.failed_ || !nothing) write(report);
    return report.failed_ ? 3 : report.denied_ ? 1 : 0;
  } catch (const InputError& error) {
    return complain(error, 3);
  } catch (const RenderError& error) {
    return complain(error, 3);
  } catch (const std::exception& error) {
    return complain(error, 2);
  }
}

/// Fails before a long computation instead of after it. Whatever an option names and is there is an input.
void Experiment::prepare_output() const {
  if (app_.count("--output") == 0) return;
  FilePlan plan;
  for (const CLI::Option* option : app_.get_options()) {
    if (option->get_single_name() == "output") continue;
    for (const std::string& value : option->results()) plan.reads_all("the input", value);
  }
  if (takes_models_)
    for (const ModelFile& model : models()) plan.reads("the model", model.path);
  plan.fills("--output", output_, [this](const std::string& name) { return is_output_of(program_, name); });
  plan.check();
  std::error_code error;
  fs::create_directories(output_, error);
  if (error) throw OutputError(output_.string() + " cannot be made: " + error.message());
}

void Experiment::write(const Report& report) const {
  const Provenance provenance = this->provenance();
  if (output_.empty()) {
    for (const auto& [name, table] : report.tables_)
      if (name.empty()) write_file_atomically("-", csv_text(table, provenance));
    return;
  }
  const auto path = [&](const std::string& name, const std::string& ending) {
    return output_ / (program_ + (name.empty() ? "" : "_" + name) + ending);
  };
  for (const auto& [name, table] : report.tables_) {
    const Table values = table.without_clocks();
    write_file_atomically(path(name, ".csv"), csv_text(values, provenance));
    write_file_atomically(path(name, ".json"), json_text(values, provenance));
    if (table.has_clocks())
      write_file_atomically(path(name, ".clocks.csv"), csv_text(table.clocks(), provenance));
  }
#ifdef STACKABILIZATION_WITH_RENDERING
  for (const auto& [name, plots] : report.plots_)
    if (std::any_of(plots.begin(), plots.end(), has_points))
      write_drawing(path(name, "." + plot_format_),
                    plots.size() == 1 ? drawing_of(plots.front()) : drawing_of(plots));
  for (const auto& [name, sheet] : report.sheets_) write_drawing(path(name, ".png"), drawing_of(sheet));
#endif
}

Provenance Experiment::provenance() const {
  Provenance result{program_, "", threads_};
  for (const CLI::Option* option : app_.get_options()) {
    const std::string name = option->get_single_name();
    if (name == "help" || name == "output" || name == "threads" || name == "plots") continue;
    std::string value = option->get_default_str();
    if (option->count() > 0) {
      value.clear();
      for (const std::string& part : option->results())
        value.append(value.empty() ? "" : " ").append(name_of(part));
    }
    if (value.empty() || value == "\"\"" || value == "[]" || value == "{}") continue;
    result.options.append(result.options.empty() ? "" : ", ").append(name).append(" = ").append(value);
  }
  return result;
}

void for_each_model(const std::vector<ModelFile>& models, Report& report,
                    const std::function<void(const ModelFile&, const Shape&, const std::string&)>& measure) {
  for (const ModelFile& model : models) try {
      measure(model, read_shape(model.path), file_hash(model.path));
    } catch (const InputError& error) {
      const std::string sentence = error.what();
      const bool named = sentence.find(model.path.filename().string()) != std::string::npos;
      report.failed(named ? sentence : model.path.string() + ": " + sentence);
    }
}

}  // namespace stackabilization::experiments
