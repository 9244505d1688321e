#include "stackabilization/stacking/validation.h"

#include <algorithm>
#include <chrono>
#include <cmath>
#include <utility>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/number_text.h"
#include "stackabilization/core/tolerances.h"
#include "stackabilization/stacking/collision.h"
#include "stackabilization/stacking/collision_probes.h"
#include "stackabilization/stacking/minkowski.h"
#include "stackabilization/stacking/tolerances.h"

namespace stackabilization {

namespace {

std::string short_number(double value) {
  return significant_text(value, 3);
}

void check_options(const ValidationOptions& options) {
  if (options.resolutions.empty() || !std::is_sorted(options.resolutions.begin(), options.resolutions.end()))
    throw UsageError("validation needs an ascending list of resolutions");
  if (!(options.collision_margin > 0)) throw UsageError("the margin of collision tests must be positive");
}

/// Runs the checks one after the other and collects their rows.
class Validator {
 public:
  Validator(const Shape& shape, const Direction& direction, const ValidationOptions& options)
      : shape_(shape), direction_(direction), options_(options) {
    validate(shape);
    check_options(options);
    report_.direction = direction.vector();
    report_.extent = range_along(shape, direction.unit()).length();
  }

  ValidationReport run() {
    exact();
    witness();
    if (report_.solid.blocked) {
      std::optional<RayCaster> caster;
      timed("build the ray caster", [&](ValidationRow& row) {
        caster.emplace(shape_);
        row.verdict = Verdict::agrees;
      });
      const HeightFieldMaker rays{"rays",
                                  [&](const Shape&, const Direction& direction, const Window& window) {
                                    return caster->cast(direction, window, options_.max_ray_hits);
                                  }};
      raster_around_witness(rays);
      raster(rays);
      raster({"scanline", height_field_by_scanline});
      for (const HeightFieldMaker& maker : options_.further_rasters) raster(maker);
    }
    collisions();
    minkowski();
    report_.passed = std::none_of(report_.rows.begin(), report_.rows.end(),
                                  [](const ValidationRow& row) { return row.verdict == Verdict::disagrees; });
    return std::move(report_);
  }

 private:
  /// Appends a row that `check` fills; an InputError becomes the reason to skip the check.
  template <class Check>
  ValidationRow& timed(const std::string& name, const Check& check) {
    ValidationRow row;
    row.name = name;
    const auto start = std::chrono::steady_clock::now();
    try {
      check(row);
    } catch (const InputError& reason) {
      row.verdict = Verdict::skipped;
      row.note = reason.what();
    }
    row.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    report_.rows.push_back(std::move(row));
    return report_.rows.back();
  }

  void skip(const std::string& name, const std::string& reason) {
    timed(name, [&](ValidationRow& row) { row.note = reason; });
  }

  void exact() {
    const SeparationTree tree(shape_);
    const auto answer = [&](ContactSemantics semantics) {
      SeparationOptions options;
      options.semantics = semantics;
      return separation(tree, tree, direction_, options);
    };
    timed("exact, solid", [&](ValidationRow& row) {
      report_.solid = answer(ContactSemantics::solid);
      row.verdict = report_.solid.blocked ? Verdict::agrees : Verdict::skipped;
      if (report_.solid.blocked)
        row.value = report_.solid.length;
      else
        row.note = "the projection along the direction has no area";
    });
    timed("exact, closed", [&](ValidationRow& row) {
      report_.closed = answer(ContactSemantics::closed);
      row.value = report_.closed.length;
      const bool ordered = !report_.solid.blocked || report_.solid.value <= report_.closed.value;
      row.verdict = ordered ? Verdict::agrees : Verdict::disagrees;
      if (!ordered) row.note = "the closed value may not be below the solid one";
    });
  }

  /// Checks that the witness points are above each other along r, at the distance of the answer.
  void witness() {
    const Separation& answer = report_.solid.blocked ? report_.solid : report_.closed;
    timed("witness points", [&](ValidationRow& row) {
      const Eigen::Vector3d apart = answer.witness.upper_point - answer.witness.lower_point;
      const Eigen::Vector3d w = direction_.unit();
      const double magnitude = std::max({report_.extent, answer.witness.upper_point.norm(), apart.norm()});
      row.value = apart.dot(w);
      set_error(row, answer.length);
      const double sideways = (apart - *row.value * w).norm();
      const double allowed = tolerance::relative * magnitude;
      row.verdict = std::abs(*row.value - answer.length) <= allowed && sideways <= allowed
                        ? Verdict::agrees
                        : Verdict::disagrees;
    });
  }

  void set_error(ValidationRow& row, double exact) const {
    if (report_.extent > 0) row.error = (*row.value - exact) / report_.extent;
  }

  /// Returns agreement, or the error of sampling; a value above the exact one only for a stated reason.
  void judge_sampled(ValidationRow& row, const HeightFieldMaker& maker) const {
    const double allowed = maker.precision * report_.extent;
    set_error(row, report_.solid.length);
    if (std::abs(*row.value - report_.solid.length) <= allowed) {
      row.verdict = Verdict::agrees;
    } else if (*row.value < report_.solid.length) {
      row.verdict = Verdict::within_sampling;
    } else if (*row.value <= report_.closed.length + allowed) {
      row.verdict = Verdict::within_sampling;
      row.note = "a sample lies on a wall along the direction, which only closed semantics count";
    } else if (!maker.excess.empty()) {
      row.verdict = Verdict::within_sampling;
      row.note = "above the exact value: " + maker.excess;
    } else {
      row.verdict = Verdict::disagrees;
      row.note = "samples may not exceed the exact value";
    }
  }

  /// Casts rays in successively smaller windows around the witness: they show the part of f_max that any
  /// sampling finds at small pixels.
  void raster_around_witness(const HeightFieldMaker& rays) {
    constexpr int samples = 64, levels = 12;
    constexpr double factor = 4;
    const Eigen::Vector3d centre = frame_of(direction_).to_local(report_.solid.witness.upper_point);
    Window window = window_around(shape_, direction_, options_.resolutions.back());
    timed("rays, zoomed in on the witness", [&](ValidationRow& row) {
      row.value = 0;
      for (int level = 0; level < levels; ++level, window.pixel_size /= factor) {
        window.columns = window.rows = samples;
        window.x = centre.x() - window.pixel_size * samples / 2;
        window.y = centre.y() - window.pixel_size * samples / 2;
        const GapMaximum found = maximum_gap(rays.make(shape_, direction_, window));
        if (found.column >= 0) row.value = std::max(*row.value, found.value);
        if (found.column >= 0 && found.value <= report_.solid.length)
          sightings_.push_back({window.pixel_size, found.value});
      }
      judge_sampled(row, rays);
      row.note += (row.note.empty() ? "" : "; ") + std::string("pixels down to ") +
                  short_number(window.pixel_size * factor);
    });
  }

  void raster(const HeightFieldMaker& maker) {
    std::optional<double> previous;
    std::string refusal;  // what does not come at one resolution does not at a finer one
    for (const int resolution : options_.resolutions) {
      const Window window = window_around(shape_, direction_, resolution);
      ValidationRow& row = timed(maker.name + " " + std::to_string(resolution), [&](ValidationRow& entry) {
        if (!refusal.empty()) throw InputError(refusal);
        entry.value = maximum_gap(maker.make(shape_, direction_, window)).value;
        judge_sampled(entry, maker);
      });
      if (row.verdict == Verdict::skipped) refusal = row.note;
      if (row.verdict == Verdict::within_sampling && row.note.empty())
        row.note = explain_shortfall(*row.value, window.pixel_size, previous);
      if (row.value && *row.value <= report_.solid.length) previous = row.value;
    }
  }

  /// Returns why a sampled value is far below the exact one, or not better than at the previous resolution;
  /// empty otherwise.
  std::string explain_shortfall(double value, double pixel, const std::optional<double>& coarser) const {
    // On a slope of f the error halves with the pixel; a part that asks for far smaller pixels is thin.
    constexpr double thin = 8;
    const double shortfall = report_.solid.length - value;
    if (shortfall <= tolerance::sampling_error * report_.extent) return {};
    const bool stuck = coarser && value <= *coarser;
    const auto sees_half = std::find_if(sightings_.begin(), sightings_.end(), [&](const Sighting& sighting) {
      return report_.solid.length - sighting.value <= shortfall / 2;
    });
    if (sees_half != sightings_.end() && sees_half->pixel < pixel / thin)
      return std::string(stuck ? "the error does not shrink: " : "") +
             "what attains f_max is thinner than the pixel of " + short_number(pixel) + "; pixels of " +
             short_number(sees_half->pixel) + " see it";
    return stuck ? "no better than the resolution before, whose samples happen to lie better" : "";
  }

  const Separation& answer_of(ContactSemantics semantics) const {
    return semantics == ContactSemantics::solid ? report_.solid : report_.closed;
  }

  std::vector<CollisionProbe> probes(ContactSemantics semantics) const {
    return collision_probes(shape_, direction_, answer_of(semantics), {semantics, options_.collision_margin});
  }

  /// A row per probe.
  void run_probes(const CollisionTester& tester, const std::vector<CollisionProbe>& probes) {
    for (const CollisionProbe& probe : probes) {
      const bool solid = probe.semantics == ContactSemantics::solid;
      const std::string name = std::string(probe.collides ? "" : "no ") + (solid ? "overlap " : "contact ") +
                               to_string(probe.place) + (solid ? " solid" : " closed") + " f_max";
      timed(name, [&](ValidationRow& row) {
        row.value = probe.lift.to_double() * direction_.length();
        const bool found = collides(tester, direction_, probe);
        row.verdict = found == probe.collides ? Verdict::agrees : Verdict::disagrees;
        if (found != probe.collides) row.note = found ? "found colliding" : "found free";
      });
    }
  }

  void collisions() {
    if (shape_.triangle_count() > options_.max_collision_triangles) {
      skip("collision tests", "more than " + std::to_string(options_.max_collision_triangles) + " triangles");
      return;
    }
    const CollisionTester tester(shape_, shape_);
    const std::vector<CollisionProbe> of_surfaces = probes(ContactSemantics::closed);
    run_probes(tester, of_surfaces);
    if (of_surfaces.back().place != ProbePlace::at)
      skip("contact at closed f_max",
           "a triangle without area attains it, and collision tests pass those over");
    const std::optional<InteriorDefect> defect = tester.interior_defect();
    if (defect)
      skip("overlap of interiors", reason_of(*defect));
    else
      run_probes(tester, probes(ContactSemantics::solid));
    bisection(tester, !defect && report_.solid.blocked ? ContactSemantics::solid : ContactSemantics::closed);
  }

  static std::string reason_of(InteriorDefect defect) {
    switch (defect) {
      case InteriorDefect::open:
        return "the shape is open or non-manifold, so it has no interior to test";
      case InteriorDefect::inside_out:
        return "some of the shape is inside out and some is not, so winding numbers do not tell its interior";
      case InteriorDefect::undecided:
        return "more than " + std::to_string(max_collision_pairs) +
               " pairs of triangles lie above each other, so winding numbers are not looked for";
      case InteriorDefect::no_volume:
        break;
    }
    return "surfaces of the shape cancel each other, as those of a part without thickness, so they enclose "
           "no "
           "interior to test";
  }

  void bisection(const CollisionTester& tester, ContactSemantics semantics) {
    BisectionOptions options;
    options.steps = options_.bisection_steps;
    options.semantics = semantics;
    const Separation& answer = answer_of(semantics);
    const std::string name = options.semantics == ContactSemantics::solid ? "solid" : "closed";
    timed("collision search from the top, " + name, [&](ValidationRow& row) {
      const std::optional<CollisionBracket> bracket = translation_by_bisection(tester, direction_, options);
      if (!bracket) {
        row.verdict = Verdict::within_sampling;
        row.note = "no step collides";
        return;
      }
      row.value = bracket->free * direction_.length();
      set_error(row, answer.length);
      row.note = std::to_string(bracket->tests) + " tests";
      if (Rational(bracket->colliding) > answer.value) {
        row.verdict = Verdict::disagrees;
        row.note += ", one collides above the exact value";
      } else if (Rational(bracket->free) < answer.value) {
        row.verdict = Verdict::within_sampling;
        row.note += "; a collision thinner than a step was passed";
      } else {
        row.verdict = Verdict::agrees;
      }
    });
  }

  void minkowski() {
    const std::string name = "Minkowski sum";
    if (!report_.solid.blocked) return skip(name, "the projection along the direction has no area");
    if (shape_.triangle_count() > max_minkowski_triangles)
      return skip(name, "more than " + std::to_string(max_minkowski_triangles) + " triangles");
    timed(name, [&](ValidationRow& row) {
      const Rational value = minkowski_translation(shape_, direction_);
      row.value = value.to_double() * direction_.length();
      set_error(row, report_.solid.length);
      row.verdict = value == report_.solid.value ? Verdict::agrees : Verdict::disagrees;
      row.note = row.verdict == Verdict::agrees ? "the same rational number" : "another rational number";
    });
  }

  /// A pixel size around the witness and the largest gap that it shows there.
  struct Sighting {
    double pixel, value;
  };

  const Shape& shape_;
  const Direction& direction_;
  const ValidationOptions& options_;
  ValidationReport report_;
  std::vector<Sighting> sightings_;
};

}  // namespace

ValidationReport validate_translation(const Shape& shape, const Direction& direction,
                                      const ValidationOptions& options) {
  return Validator(shape, direction, options).run();
}

}  // namespace stackabilization
