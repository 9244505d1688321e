#pragma once

#include <filesystem>
#include <optional>
#include <ostream>
#include <string>
#include <vector>

#include "paper_figures/figure.h"

namespace stackabilization::figures {

/// What is made, and from what.
struct RunOptions {
  std::vector<int> figures;                         ///< numbers; empty: all
  std::filesystem::path inputs;                     ///< folder with figure_01.json and so on
  std::filesystem::path models;                     ///< folder of this project's models
  std::optional<std::filesystem::path> paper_data;  ///< folder of the authors' models, to be used instead
  std::filesystem::path output;                     ///< folder, made where it is missing
};

/// What a run came to.
struct RunReport {
  std::vector<std::string> failures;  ///< one sentence for each figure that could not be made
  int figures = 0;                    ///< that were made
  int broken_claims = 0;              ///< claims of figures that do not hold
};

/// "figure_05".
std::string stem_of(int figure);

/// The text of an input that is for people.
struct Prose {
  std::string paper;       ///< what the paper's figure shows
  std::string difference;  ///< what is known to differ in ours, and why
  /// The same where it is made from the authors' models; nothing where it cannot be.
  std::optional<std::string> authors_difference;
};
Prose read_prose(const std::filesystem::path& input, const Figure& figure);

/// Throws UsageError when an output, or the Markdown file `page` (empty: none), would replace an input,
/// OutputError when one cannot be written.
void check_outputs(const RunOptions& options, const std::filesystem::path& page);

/// Makes figures into `output`: NN.png and NN.numbers.json each (NN = `stem_of`), NN.svg where it is a plot,
/// and timings.json. The same input gives the same bytes, but for the timings. A figure that fails does not
/// stop the others; of all figures, those without an input on the authors' models are passed over when these
/// are asked for. One line a figure goes to `log`.
///
/// Throws UsageError for a number that is no figure or a figure asked for that cannot be made from the
/// authors' models, InputError when a folder is missing, OutputError when `output` cannot be written.
RunReport make_figures(const RunOptions& options, std::ostream& log);

}  // namespace stackabilization::figures
