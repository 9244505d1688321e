#include <algorithm>
#include <cmath>
#include <sstream>

#include "paper_figures/figure.h"
#include "paper_figures/shown.h"
#include "stackabilization/core/number_text.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/envelope/height_field.h"
#include "stackabilization/io/format.h"
#include "stackabilization/io/read.h"

namespace stackabilization::figures {
namespace {

constexpr int samples = 1500;

/// The outline of a bench seen from the front, drawn out to a prism: lengths in metres.
struct Bench {
  double top = 0, height = 0, thickness = 0, leg = 0, depth = 0;
};

/// A slightly different bench.
struct BenchVariant {
  std::string name;
  double lean = 0;  ///< by which the feet stand farther out than the tops of the legs, metres
  double bar = 0;   ///< height of a bar between the legs, metres; 0: none
};

struct Figure04Options {
  Bench bench;
  std::vector<BenchVariant> variants;
  double max_lean = 0;  ///< of the curve, metres
};

Figure04Options read_figure_04(const Fields& fields) {
  const Fields bench = fields.object("bench");
  Figure04Options options{{bench.number("top"), bench.number("height"), bench.number("thickness"),
                           bench.number("leg"), bench.number("depth")},
                          {},
                          fields.number("most_lean")};
  if (!(options.bench.leg > 0) || !(options.bench.thickness > 0) || !(options.bench.depth > 0) ||
      options.bench.top <= 2 * options.bench.leg || options.bench.height <= 2 * options.bench.thickness)
    fields.refuse("bench", "positive lengths, with room between the legs and below the top");
  for (const Fields& variant : fields.objects("variants"))
    options.variants.push_back({variant.text("name"), variant.number("lean"), variant.number("bar")});
  return options;
}

using ConvexPolygon = std::vector<Eigen::Vector2d>;

/// A polygon drawn out along y, counter-clockwise seen from -y. The reader cuts the polygons into triangles.
Shape prism(const ConvexPolygon& outline, double depth) {
  const std::size_t count = outline.size();
  std::ostringstream front, back, sides, vertices;
  vertices.precision(17);
  for (const double y : {-depth / 2, depth / 2})
    for (const Eigen::Vector2d& p : outline) vertices << "v " << p.x() << ' ' << y << ' ' << p.y() << '\n';
  for (std::size_t k = 0; k < count; ++k) {
    const std::size_t next = (k + 1) % count;
    front << ' ' << k + 1;
    back << ' ' << 2 * count - k;
    sides << "f " << next + 1 << ' ' << k + 1 << ' ' << count + k + 1 << ' ' << count + next + 1 << '\n';
  }
  const std::string text = vertices.str() + "f" + front.str() + "\nf" + back.str() + "\n" + sides.str();
  ReadOptions options;
  options.unit = Unit::metre;
  return read_shape(text, Format::obj, "bench", options);
}

Shape bench_shape(const Bench& bench, const BenchVariant& variant) {
  const double a = bench.top / 2, under = bench.height - bench.thickness;
  const double foot = a + variant.lean;
  Shape shape = prism({{-foot, 0},
                       {-foot + bench.leg, 0},
                       {-a + bench.leg, under},
                       {a - bench.leg, under},
                       {foot - bench.leg, 0},
                       {foot, 0},
                       {a, under},
                       {a, bench.height},
                       {-a, bench.height},
                       {-a, under}},
                      bench.depth);
  if (variant.bar <= 0) return shape;
  const double reach = foot - variant.lean * variant.bar / under - bench.leg / 2;
  const double low = variant.bar - bench.thickness / 2, high = variant.bar + bench.thickness / 2;
  return concatenate(shape,
                     prism({{-reach, low}, {reach, low}, {reach, high}, {-reach, high}}, 0.5 * bench.depth));
}

/// The gap function across the bench, along the middle of its depth.
CurvePlot bench_gap_plot(const Shape& shape, const Stackability& measured, const Figure04Options& options) {
  const Direction up(measured.direction);
  const double half = options.bench.top / 2 + options.max_lean;
  const Window window{-half, 0, 2 * half / samples, samples, 1};
  const Eigen::MatrixXd values = gap(height_field_by_scanline(shape, up, window));
  CurvePlot plot;
  plot.x.range = Range{-half, half};
  plot.y.range = Range{0, 1.12 * options.bench.height};
  PlotSeries f{"", palette::upper, {}, PlotLine::over_area};
  for (int i = 0; i < samples; ++i) f.points.emplace_back(window.sample(i, 0).x(), values(i, 0));
  plot.series = {f,
                 {"", palette::contact, {{-half, measured.f_max}, {half, measured.f_max}}, PlotLine::thin}};
  return plot;
}

/// The highest point of the curve of a panel.
double largest_gap(const Panel& panel) {
  double largest = 0;
  for (const Eigen::Vector2d& point : std::get<CurvePlot>(panel.content).series.front().points)
    if (point.y() > largest) largest = point.y();
  return largest;
}

/// S over the lean of the legs, with the variants that have no bar.
CurvePlot lean_plot(const Figure04Options& options, const std::vector<double>& values) {
  constexpr int steps = 80;
  CurvePlot plot;
  plot.x = {"lean of the legs in m", Range{0, options.max_lean}};
  plot.y = {"S", Range{-0.15, 0.8}};
  PlotSeries curve{"", palette::upper, {}}, shown{"", palette::contact, {}, PlotLine::none, PlotMark::circle};
  for (int k = 0; k <= steps; ++k) {
    const double lean = options.max_lean * k / steps;
    const Shape shape = bench_shape(options.bench, {"", lean, 0});
    curve.points.emplace_back(lean, stackability(shape, Direction(0, 0, 1)).value);
  }
  for (std::size_t k = 0; k < values.size(); ++k) {
    shown.points.emplace_back(options.variants[k].lean, values[k]);
    plot.notes.push_back(
        {shown.points.back() + Eigen::Vector2d(0.012 * options.max_lean, -0.08), options.variants[k].name});
  }
  plot.series = {curve, shown};
  return plot;
}

FigureResult make_figure_04(const Figure04Options& options, const ModelFolder&) {
  const Direction up(0, 0, 1);
  PanelRow shapes, gaps, curve;
  shapes.height = 0.22;
  shapes.scale = PanelScale::common;
  gaps.height = 0.27;
  curve.height = 0.36;
  FigureResult result;
  result.kind = FigureKind::plot;
  std::vector<double> values;
  double largest_excess = -options.bench.height;
  for (const BenchVariant& variant : options.variants) {
    const Shape shape = bench_shape(options.bench, variant);
    const Stackability measured = stackability(shape, up);
    Scene scene;
    scene.add({shape, {palette::input}});
    shapes.panels.push_back({scene_panel(std::move(scene), up, {8, 8}),
                             variant.name + ": S = " + significant_text(std::max(0.0, measured.value), 2),
                             {},
                             1});
    gaps.panels.push_back({bench_gap_plot(shape, measured, options), "", {}, 1});
    largest_excess = std::max(largest_excess,
                              largest_gap(gaps.panels.back()) - (1 + tolerance::relative) * measured.f_max);
    result.numbers.push_back({"lean of the legs, " + variant.name, variant.lean, "m"});
    result.numbers.push_back({"f_max, " + variant.name, measured.f_max, "m"});
    result.numbers.push_back({"S, " + variant.name, measured.value});
    values.push_back(measured.value);
  }
  curve.panels = {{lean_plot(options, values), "", {}, 1}};
  const auto [least, largest] = std::minmax_element(values.begin(), values.end());
  constexpr double considerable = 0.5;
  result.claims = {{"the shapes differ by at most " + length_text(options.max_lean, Unit::metre) +
                        " at the feet and one bar, and S by more than 0.5",
                    *largest - *least > considerable},
                   {"no sample of a gap function exceeds f_max, from which S follows", largest_excess <= 0}};
  PanelSheetOptions sheet;
  sheet.legend = {
      {LegendMark::swatch, mix(palette::upper, palette::white, 0.5), "gap function f in m, across the shape"},
      {LegendMark::line, palette::contact, "its maximum, f_max"}};
  result.drawing = panel_sheet({shapes, gaps, curve}, sheet);
  return result;
}

}  // namespace

Figure figure_04() {
  return figure(4, "Slight deformations change the gap function and S considerably", read_figure_04,
                make_figure_04);
}

}  // namespace stackabilization::figures
