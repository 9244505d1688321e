#pragma once

#include <filesystem>
#include <string>

namespace stackabilization::figures {

/// From what the page is put together.
struct PageOptions {
  std::filesystem::path inputs;   ///< folder with figure_01.json and so on
  std::filesystem::path figures;  ///< folder that `make_figures` wrote
  std::filesystem::path page;     ///< where the page will be: pictures are linked relative to its folder
};

/// figures.md: a table of all figures that were made, and a section for each with what the paper shows, the
/// picture, the command, its time, the numbers, what agrees, and the known difference. Every number comes
/// from the files that the run wrote. Throws InputError when there is none or one is damaged.
std::string figures_page(const PageOptions& options);

}  // namespace stackabilization::figures
