// Question: how does the cost of the exact separation grow with the number of triangles?
//
//     separation_scaling [--largest N] [--directions N] [-o FILE.csv] [--picture FILE.svg]
//
// One row per size of a thin-walled cup with a wavy wall, from 1,000 triangles doubling up to N (default
// 1,048,576), on one thread: milliseconds to build the tree, and median milliseconds of one more direction,
// as an enclosure and as a rational number, over evenly spread directions, and along the axis of the cup,
// where its whole wall slides into itself. The comment lines after the rows give the exponents of the
// least-squares power laws: 1 is linear. The picture draws the rows over each other with a linear one for
// comparison.

#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>
#include <iterator>
#include <numbers>

#include "common/lattice.h"
#include "common/provenance.h"
#include "stackabilization/envelope/separation.h"
#include "stackabilization/shape/errors.h"
#include "stackabilization/shape/write_file.h"
#ifdef STACKABILIZATION_WITH_RENDERING
#include "common/log_plot.h"
#endif

using namespace stackabilization;
using namespace stackabilization::experiments;

namespace {

/// A cup 90 high that widens from radius 30 to 40, walls 2 thick, with 12 waves around and 5 up the wall; a
/// closed surface of about `triangles` triangles.
Shape wavy_cup(int triangles) {
  const int rows = static_cast<int>(std::sqrt(triangles / 2.0)), columns = rows;
  Points vertices(rows * columns, 3);
  // The profile runs along a closed curve: up the outer wall, over the rim, down the inner one; a small hole
  // stays at the axis.
  for (int i = 0; i < rows; ++i) {
    const double t = 2.0 * i / rows;
    const bool outside = t < 1;
    const double s = outside ? t : 2 - t;  // 0 at the hole, 1 at the rim
    const double wall = std::clamp((s - 0.25) / 0.75, 0.0, 1.0);
    const double z = (outside ? 0 : 2 * (1 - wall)) + 90 * wall;
    const double mean = (s < 0.25 ? 30 * (s + 0.01) / 0.26 : 30 + 10 * wall) - (outside || s < 0.25 ? 0 : 2);
    for (int j = 0; j < columns; ++j) {
      const double angle = 2 * std::numbers::pi * j / columns;
      const double wave = 1 + 0.02 * wall * std::sin(12 * angle) * std::sin(5 * std::numbers::pi * wall);
      vertices.row(i * columns + j) << mean * wave * std::cos(angle), mean * wave * std::sin(angle), z;
    }
  }
  Triangles faces(2 * rows * columns, 3);
  for (int i = 0; i < rows; ++i)
    for (int j = 0; j < columns; ++j) {
      const int next = (i + 1) % rows * columns, right = (j + 1) % columns, row = i * columns;
      faces.row(2 * (row + j)) << row + j, row + right, next + right;
      faces.row(2 * (row + j) + 1) << row + j, next + right, next + j;
    }
  return make_shape(vertices, faces);
}

struct Row {
  double triangles, build_ms, enclosure_ms, rational_ms, axis_ms;

  std::string text() const {
    char numbers[128];
    std::snprintf(numbers, sizeof numbers, "%.0f,%.3f,%.4f,%.4f,%.4f\n", triangles, build_ms, enclosure_ms,
                  rational_ms, axis_ms);
    return numbers;
  }
};

template <typename Query>
double median_ms(const std::vector<Direction>& directions, const Query& query) {
  std::vector<double> times;
  for (const Direction& direction : directions) {
    const double start = now();
    query(direction);
    times.push_back(1e3 * (now() - start));
  }
  return median(times);
}

Row measure(int triangles, int directions) {
  const Shape shape = wavy_cup(triangles);
  const double start = now();
  const SeparationTree tree(shape);
  Row row{static_cast<double>(shape.triangle_count()), 1e3 * (now() - start), 0, 0, 0};
  const std::vector<Direction> lattice = hemisphere_lattice(directions);
  row.enclosure_ms = median_ms(lattice, [&](const Direction& r) { separation_enclosure(tree, tree, r); });
  row.rational_ms = median_ms(lattice, [&](const Direction& r) { separation(tree, tree, r); });
  row.axis_ms = median_ms({5, Direction(0, 0, 1)}, [&](const Direction& r) { separation(tree, tree, r); });
  return row;
}

/// Exponent of the power law through the rows, by least squares of the logarithms.
double exponent(const std::vector<Row>& rows, double Row::*cost) {
  double mean_x = 0, mean_y = 0, xy = 0, xx = 0;
  for (const Row& row : rows) {
    mean_x += std::log(row.triangles) / static_cast<double>(rows.size());
    mean_y += std::log(row.*cost) / static_cast<double>(rows.size());
  }
  for (const Row& row : rows) {
    const double x = std::log(row.triangles) - mean_x;
    xy += x * (std::log(row.*cost) - mean_y);
    xx += x * x;
  }
  return xy / xx;
}

struct Quantity {
  const char* name;
  const char* caption;
  double Row::*cost;
};

constexpr Quantity quantities[] = {{"build_ms", "tree, once per shape", &Row::build_ms},
                                   {"axis_ms", "along the axis, rational", &Row::axis_ms},
                                   {"rational_ms", "one direction, rational", &Row::rational_ms},
                                   {"enclosure_ms", "one direction, enclosure", &Row::enclosure_ms}};

std::string exponents(const std::vector<Row>& rows) {
  std::string lines;
  for (const Quantity& quantity : quantities) {
    char text[80];
    std::snprintf(text, sizeof text, "# exponent of %s: %.2f\n", quantity.name,
                  exponent(rows, quantity.cost));
    lines += text;
  }
  return lines;
}

#ifdef STACKABILIZATION_WITH_RENDERING
void draw(const std::vector<Row>& rows, const std::string& path) {
  LogPlot plot{"Cost of the exact separation, wavy cup, one thread", "triangles", "milliseconds", {}};
  const Colour colours[] = {palette::output, palette::contact, palette::lower, palette::upper};
  for (std::size_t q = 0; q < std::size(quantities); ++q) {
    plot.series.push_back({quantities[q].caption, colours[q], {}});
    for (const Row& row : rows)
      plot.series.back().points.emplace_back(row.triangles, row.*quantities[q].cost);
  }
  const double unit = rows.front().rational_ms / rows.front().triangles;
  plot.series.push_back({"linear", palette::faint, {}, true});
  for (const Row& row : rows) plot.series.back().points.emplace_back(row.triangles, unit * row.triangles);
  write_drawing(path, log_plot(plot));
}
#endif

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"How the cost of the exact separation grows with the number of triangles."};
  int largest = 1 << 20, directions = 50;
  std::string output = "-", picture;
  app.add_option("--largest", largest, "triangles of the largest cup")->check(CLI::Range(2048, 1 << 24));
  app.add_option("--directions", directions, "directions per cup")->check(CLI::Range(1, 100000));
  app.add_option("-o", output, "CSV file; - is standard output");
#ifdef STACKABILIZATION_WITH_RENDERING
  app.add_option("--picture", picture, "plot, PNG or SVG");
#endif
  CLI11_PARSE(app, argc, argv);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  try {
    std::string csv =
        provenance_lines({"separation_scaling", std::vector<std::string>(argv + 1, argv + argc), 1}) +
        "triangles,build_ms,enclosure_ms,rational_ms,axis_ms\n";
    std::vector<Row> rows;
    for (int triangles = 1024; triangles <= largest; triangles *= 2) {
      rows.push_back(measure(triangles, directions));
      csv += rows.back().text();
    }
    write_file_atomically(output, csv + exponents(rows));
#ifdef STACKABILIZATION_WITH_RENDERING
    if (!picture.empty()) draw(rows, picture);
#endif
  } catch (const Error& error) {
    std::cerr << "separation_scaling: " << error.what() << "\n";
    return 2;
  }
  return 0;
}
