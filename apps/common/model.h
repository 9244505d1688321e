#pragma once

#include <chrono>
#include <string>

#include "apps/common/common_options.h"
#include "apps/common/json.h"
#include "apps/common/text.h"
#include "stackabilization/core/errors.h"
#include "stackabilization/core/shape.h"
#include "stackabilization/io/inspect.h"

namespace stackabilization::apps {

/// Wall clock since its construction.
class Stopwatch {
 public:
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

 private:
  using Clock = std::chrono::steady_clock;
  Clock::time_point start_ = Clock::now();
};

/// A mesh file read, and looked over.
struct Model {
  std::string name;  ///< as on the command line
  Shape shape;
  Findings findings;
};

/// "chair.obj", "standard input".
std::string display_name(const Model& model);

/// The same without folders, for headings.
std::string title_of(const Model& model);

/// What `work` returns; the model's name is put before what it says about the shape. Throws as `work` does.
template <class Work>
auto named(const Model& model, const Work& work) {
  try {
    return work();
  } catch (const InputError& error) {
    throw InputError(display_name(model) + ": " + error.what());
  }
}

/// Reads MODEL as `common` says. Throws InputError.
Model load_model(const CommonOptions& common, const InspectOptions& options = {});

/// Throws UsageError when --to-unit is given and the unit of the shape is not known.
void check_unit(const CommonOptions& common, const Shape& shape);

/// Reads another mesh as MODEL is read, but for its format and labels. Throws InputError.
Model load_other_model(CommonOptions common, const std::string& path);

/// Throws UsageError, with what the other model is called on the command line, when the two are in different
/// units.
void check_same_unit(const Model& model, const Model& other, const std::string& name_of_other);

/// {command, version, model, unit}: how every JSON document begins.
Json document_head(const std::string& command, const Model& model);
Json document_head(const CLI::App& command, const Model& model);

/// {findings, seconds}: how it ends.
void add_document_tail(Json& document, const CommonOptions& common, const Model& model,
                       const Stopwatch& watch);

/// First line of every report.
void add_model_line(TextTable& table, const Model& model);

}  // namespace stackabilization::apps
