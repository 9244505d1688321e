// Question: what does one more direction cost, exactly and by every other road?
//
//     separation_speed [--directions N] [--slow-directions N] [-o FILE.csv] MODEL...
//
// One row per model and method, all in one process on one thread: milliseconds to prepare the shape, median
// and largest milliseconds per direction, the ratio of the median to that of the exact method, and the
// largest error of f_max against the exact one as a fraction of the extent. Collision methods count touching
// as collision (closed semantics), so flush walls show as error there. Methods slower than the exact one by
// far are run on fewer directions.

#include <tbb/global_control.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cmath>
#include <cstdio>
#include <iostream>

#include "common/lattice.h"
#include "common/provenance.h"
#include "speed/competitor.h"
#include "stackabilization/envelope/height_field.h"
#include "stackabilization/envelope/separation.h"
#include "stackabilization/shape/errors.h"
#include "stackabilization/shape/read.h"
#include "stackabilization/shape/write_file.h"
#ifdef STACKABILIZATION_WITH_RENDERING
#include "stackabilization/rendering/depth_raster.h"
#endif

using namespace stackabilization;
using namespace stackabilization::experiments;

namespace {

Competitor exact(const Shape& shape) {
  Competitor result;
  result.name = "exact (rational)";
  const double start = now();
  const auto tree = std::make_shared<SeparationTree>(shape);
  result.build_seconds = now() - start;
  result.measure = [tree](const Direction& direction) { return separation(*tree, *tree, direction).length; };
  return result;
}

Competitor enclosure(const Shape& shape) {
  Competitor result;
  result.name = "exact (enclosure)";
  const double start = now();
  const auto tree = std::make_shared<SeparationTree>(shape);
  result.build_seconds = now() - start;
  result.measure = [tree](const Direction& direction) {
    return separation_enclosure(*tree, *tree, direction).upper * direction.length();
  };
  return result;
}

Competitor scanline(const Shape& shape, int resolution) {
  Competitor result;
  result.name = "CPU raster " + std::to_string(resolution);
  result.measure = [&shape, resolution](const Direction& direction) {
    return maximum_gap(
               height_field_by_scanline(shape, direction, window_around(shape, direction, resolution)))
        .value;
  };
  return result;
}

#ifdef STACKABILIZATION_WITH_RENDERING
Competitor depth_buffer(const Shape& shape, int resolution) {
  Competitor result;
  result.name = "OpenGL raster " + std::to_string(resolution);
  const double start = now();
  const auto rasterizer = std::make_shared<DepthRasterizer>(shape);
  result.build_seconds = now() - start;
  result.measure = [rasterizer, &shape, resolution](const Direction& direction) {
    return maximum_gap(rasterizer->height_field(direction, window_around(shape, direction, resolution)))
        .value;
  };
  return result;
}
#endif

std::vector<Competitor> competitors(const Shape& shape) {
  std::vector<Competitor> list = {exact(shape), enclosure(shape), scanline(shape, 256),
                                  scanline(shape, 1024)};
#ifdef STACKABILIZATION_WITH_RENDERING
  list.push_back(depth_buffer(shape, 1024));
#endif
#ifdef STACKABILIZATION_WITH_EMBREE
  list.push_back(embree_rays(shape, 1024));
#endif
#ifdef STACKABILIZATION_WITH_FCL
  list.push_back(fcl_bisection(shape));
#endif
  list.push_back(cgal_bisection(shape));
  return list;
}

struct Row {
  std::string model, hash, method;
  long triangles;
  int directions;
  double build_ms, median_ms, largest_ms, ratio, error;

  std::string text() const {
    char numbers[256];
    std::snprintf(numbers, sizeof numbers, "%ld,%d,%.3f,%.4f,%.4f,%.2f,%.3g", triangles, directions, build_ms,
                  median_ms, largest_ms, ratio, error);
    return model + "," + hash + "," + method + "," + numbers + "\n";
  }
  static std::string header() {
    return "model,input_hash,method,triangles,directions,build_ms,median_ms,largest_ms,ratio_to_exact,"
           "largest_error_over_height\n";
  }
};

double extent(const Shape& shape, const Direction& direction) {
  const Eigen::VectorXd heights = shape.vertices * direction.unit();
  return heights.maxCoeff() - heights.minCoeff();
}

std::vector<Row> compare(const std::string& model, int count, int slow_count) {
  const Shape shape = read_shape(model);
  std::vector<Row> rows;
  std::vector<double> reference;
  for (const Competitor& competitor : competitors(shape)) {
    const int runs = rows.size() < 2 ? count : std::min(count, slow_count);
    const std::vector<Direction> directions = hemisphere_lattice(count);
    std::vector<double> times;
    double error = 0;
    for (int d = 0; d < runs; ++d) {
      // The slow ones see directions spread over the whole list.
      const std::size_t at = static_cast<std::size_t>(d) * directions.size() / static_cast<std::size_t>(runs);
      const double start = now();
      const double value = competitor.measure(directions[at]);
      times.push_back(1e3 * (now() - start));
      if (rows.empty()) reference.push_back(value);
      error = std::max(error, std::abs(value - reference[at]) / extent(shape, directions[at]));
    }
    Row row{model,
            file_hash(model),
            competitor.name,
            static_cast<long>(shape.triangle_count()),
            runs,
            1e3 * competitor.build_seconds,
            median(times),
            *std::max_element(times.begin(), times.end()),
            1,
            error};
    if (!rows.empty()) row.ratio = row.median_ms / rows.front().median_ms;
    rows.push_back(row);
  }
  return rows;
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app{"What one more direction costs, exactly and by every other road."};
  int directions = 200, slow_directions = 10;
  std::string output = "-";
  std::vector<std::string> models;
  app.add_option("--directions", directions, "directions for the exact method")->check(CLI::Range(1, 100000));
  app.add_option("--slow-directions", slow_directions, "directions for every other method")
      ->check(CLI::Range(1, 100000));
  app.add_option("-o", output, "CSV file; - is standard output");
  app.add_option("models", models, "mesh files")->required();
  CLI11_PARSE(app, argc, argv);
  const tbb::global_control one_thread(tbb::global_control::max_allowed_parallelism, 1);
  try {
    std::string csv =
        provenance_lines({"separation_speed", std::vector<std::string>(argv + 1, argv + argc), 1}) +
        Row::header();
    for (const std::string& model : models)
      for (const Row& row : compare(model, directions, slow_directions)) csv += row.text();
    write_file_atomically(output, csv);
  } catch (const InputError& error) {
    std::cerr << "separation_speed: " << error.what() << "\n";
    return 3;
  } catch (const Error& error) {
    std::cerr << "separation_speed: " << error.what() << "\n";
    return 2;
  }
  return 0;
}
