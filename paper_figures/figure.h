#pragma once

#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "paper_figures/input.h"
#include "stackabilization/rendering/drawing.h"

/// The figures of the paper, each made by one function from one input file.
namespace stackabilization::figures {

/// A result that belongs to a figure.
struct Number {
  std::string name;                  ///< what it is
  Json value;                        ///< a number or a text
  std::string unit = {};             ///< "mm"; empty for ratios and counts
  std::optional<double> paper = {};  ///< the same in the paper
};

/// What the paper's figure is there to show, and whether ours shows it too.
struct Claim {
  std::string says;  ///< one sentence, without a full stop
  bool holds = false;
};

/// What is written as .svg beside the .png.
enum class FigureKind {
  picture,  ///< mostly rendered: nothing
  plot,     ///< mostly lines and text: the drawing
};

/// A figure made.
struct FigureResult {
  Drawing drawing;
  std::vector<Number> numbers;
  std::vector<Claim> claims;
  FigureKind kind = FigureKind::picture;
};

/// A figure ready to be made: its options were read and checked.
using PreparedFigure = std::function<FigureResult(const ModelFolder&)>;

/// A figure of the paper.
struct Figure {
  int number = 0;
  std::string title;
  std::function<PreparedFigure(const Fields& options)> prepare;  ///< throws InputError
};

/// A figure from the function that reads its options and the one that makes it.
template <class Options>
Figure figure(int number, std::string title, Options (*read)(const Fields&),
              FigureResult (*make)(const Options&, const ModelFolder&)) {
  return {number, std::move(title), [read, make](const Fields& fields) {
            return PreparedFigure(
                [options = read(fields), make](const ModelFolder& models) { return make(options, models); });
          }};
}

Figure figure_01();
Figure figure_02();
Figure figure_03();
Figure figure_04();
Figure figure_05();
Figure figure_06();
Figure figure_07();
Figure figure_08();
Figure figure_09();
Figure figure_10();
Figure figure_11();
Figure figure_12();
Figure figure_13();
Figure figure_14();
Figure figure_15();

/// All of them, by number.
std::vector<Figure> all_figures();

}  // namespace stackabilization::figures
