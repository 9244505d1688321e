#include "improvement/explanation/part_changes.h"

#include <Eigen/Geometry>
#include <Eigen/SVD>
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <numbers>
#include <utility>

#include "core/angles.h"
#include "core/index.h"
#include "improvement/explanation/affine_split.h"
#include "improvement/explanation/taper_fit.h"
#include "mesh/surface_moments.h"
#include "stackabilization/improvement/tolerances.h"

namespace stackabilization::detail {

namespace {

using Kind = FormChangeKind;
namespace limit = tolerance::explanation;

constexpr double degrees_of_radian = 180 / std::numbers::pi;
/// Cosines of the angles within which a direction is upright, points along another, or is level.
constexpr double upright_cosine = 0.7071067811865476, along_cosine = 0.8, level_cosine = 0.3;
/// Distance from the middle of the object, as a ratio of half its size along a heading, from which on that
/// heading leads outwards or inwards: the legs on a long side of a bed lean outwards across it.
constexpr double heading_share = 0.5;
/// Ratio of thickness to width up to which a part is a plate.
constexpr double plate_ratio = 0.25;
/// Least ratio of width to thickness of a slat.
constexpr double slat_ratio = 2;
/// Share of the two large sides of its box up to which the surface of such a part is that of a frame.
constexpr double frame_share = 0.6;
/// Ratio of the level sizes of a part from which on the larger one is its length.
constexpr double length_ratio = 1.25;
/// Ratio of the height of a part to its smaller level size from which on it is upright.
constexpr double upright_ratio = 1.5;
/// Ratio of length to mean radius below which a member is a body with a width.
constexpr double stout_length = 6;
/// Share of the rectangle around the upper end, seen from above, that faces up there on an open vessel, at
/// most; and how far down that end reaches, of the height.
constexpr double open_share = 0.47, rim_share = 0.1;
/// Departure from a chord or an affine image from which on a part is deformed, in visible displacements.
constexpr double deformed = 5;
/// A change is left out beside one of the object that a person sees so much better, as a ratio of multiples
/// of what is seen.
constexpr double minor = 1.0 / 7;
/// Pieces of the surface of a part: enough for a vessel of many triangles.
constexpr std::size_t max_form_pieces = 40000;
constexpr int sweeps = 100;

/// Returns the one of two ratios that is nearer to 1; 1 if they are on different sides of it.
double nearer(double a, double b) {
  if ((a - 1) * (b - 1) <= 0) return 1;
  return std::abs(a - 1) < std::abs(b - 1) ? a : b;
}

/// Returns whether a part changes as its centre line does: a straight member, but for boards and panels that
/// lie along theirs, which also turn about it.
bool is_member(const PartAtRest& part, const ObjectFrame& frame) {
  if (!part.form.line || !part.form.line->is_straight()) return false;
  const Eigen::Vector3d box = part.high - part.low;  // longest first
  return box(2) >= plate_ratio * box(1) ||
         std::abs(part.form.line->direction().dot(frame.up)) >= upright_cosine;
}

/// Collects the changes of one part.
class PartMeasurement {
 public:
  PartMeasurement(const PartAtRest& part, const Shape& rest, const Shape& now, const ObjectFrame& frame)
      : part_(part), rest_(rest), now_(now), frame_(frame), marks_(part.form.marks.on(now)) {
    result_.map = part.form.fit->map(marks_);
    result_.map.to -= frame.shift;
    for (const std::int32_t t : part.triangles)
      for (int k = 0; k < 3; ++k)
        result_.displacement =
            std::max(result_.displacement, (now.corner(t, k) - rest.corner(t, k) - frame.shift).norm());
  }

  PartChanges run() {
    if (result_.displacement < frame_.visible()) return std::move(result_);
    if (is_member(part_, frame_))
      measure_member();
    else
      measure_body();
    std::stable_sort(result_.changes.begin(), result_.changes.end(),
                     [](const auto& a, const auto& b) { return a.change.kind < b.change.kind; });
    return std::move(result_);
  }

 private:
  /// Adds a change from the amount `least` on.
  void add(Kind kind, double amount, double least, Heading heading = Heading::none) {
    if (std::abs(amount) >= least) result_.changes.push_back({{kind, amount, heading}, least});
  }
  /// Adds a rotation or shear that moves the ends of something of length `extent` apart.
  void add_angle(Kind kind, double radians, double extent, Heading heading = Heading::none) {
    if (extent > 0)
      add(kind, radians * degrees_of_radian, frame_.visible() / extent * degrees_of_radian, heading);
  }
  /// Returns the change of a size from which on it is named.
  double named_ratio(double extent) const {
    return std::min(limit::ratio, extent > 0 ? 2 * frame_.visible() / extent : limit::ratio);
  }
  void add_ratio(Kind kind, double factor, double extent) { add(kind, factor - 1, named_ratio(extent)); }
  bool is_seen(double factor, double extent) const { return std::abs(factor - 1) >= named_ratio(extent); }

  Range range(const Eigen::Vector3d& axis) const {
    Range result{std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity()};
    for (const std::int32_t t : part_.triangles)
      for (int k = 0; k < 3; ++k) {
        const double place = axis.dot(rest_.corner(t, k));
        result = {std::min(result.low, place), std::max(result.high, place)};
      }
    return result;
  }
  bool stands() const { return range(frame_.up).low - frame_.ground <= limit::standing * frame_.height; }

  Heading heading(const Eigen::Vector3d& by) const {
    const Eigen::Vector3d out = frame_.level(result_.map.from - frame_.centre), way = frame_.level(by);
    if (out.norm() <= limit::on_axis * frame_.diagonal || !(way.norm() > 0)) return Heading::sideways;
    const Eigen::Vector3d along = way.normalized();
    double reach = 0;
    for (Eigen::Index v = 0; v < rest_.vertex_count(); ++v)
      reach = std::max(reach, std::abs(along.dot(rest_.vertices.row(v).transpose() - frame_.centre)));
    const double from_middle = along.dot(out);
    if (from_middle >= heading_share * reach) return Heading::outwards;
    return from_middle <= -heading_share * reach ? Heading::inwards : Heading::sideways;
  }

  void measure_member() {
    const CentreLine& line = *part_.form.line;
    CentreLineChange change = line.change(now_, result_.map);
    std::array<Eigen::Vector3d, 2> ends = line.ends(rest_);
    Eigen::Vector3d before = line.direction(), after = change.direction;
    std::array<double, 2> widths = change.end_widths;
    if (before.dot(frame_.up) < 0) {
      before = -before;
      after = -after;
      std::swap(widths[0], widths[1]);
      std::swap(ends[0], ends[1]);
      std::swap(change.ends[0], change.ends[1]);
    }
    for (std::size_t end = 0; end < 2; ++end) change.ends[end] -= ends[end] + frame_.shift;
    const bool upright = before.dot(frame_.up) >= upright_cosine;
    const double length = (ends[1] - ends[0]).norm(),
                 stretch = (ends[1] - ends[0] + change.ends[1] - change.ends[0]).norm() / length;
    // A leaning member may be cut off level at its ends, or turn with them.
    const double lean_factor = upright ? after.dot(frame_.up) / before.dot(frame_.up)
                                       : frame_.level(after).norm() / frame_.level(before).norm();
    if (!(lean_factor > 0)) return;
    if (upright) {
      measure_lean(before, after, change.ends, length);
    } else {
      add_angle(Kind::tilt, std::abs(std::asin(after.dot(frame_.up)) - std::asin(before.dot(frame_.up))),
                length);
      add_angle(Kind::turn, angle_between(frame_.level(before), frame_.level(after)), length);
    }
    const bool stout = length < stout_length * line.radius();
    add_ratio(stout && upright ? Kind::tallness : Kind::length, nearer(stretch, stretch * lean_factor),
              2 * length);
    for (double& width : widths) width = nearer(width, width * 2 / (1 + lean_factor));
    measure_widths(widths, upright, stout);
    const Eigen::Vector3d between = change.ends[1] - change.ends[0];
    const double squared = between.squaredNorm();
    add_place(change.ends[0] +
              (squared > 0 ? std::clamp(-change.ends[0].dot(between) / squared, 0.0, 1.0) : 0) * between);
    add(Kind::bend, change.straightness * change.length * length / frame_.height,
        deformed * frame_.visible() / frame_.height);
  }

  /// `moves`: displacements of the lower and the upper end.
  void measure_lean(const Eigen::Vector3d& before, const Eigen::Vector3d& after,
                    const std::array<Eigen::Vector3d, 2>& moves, double length) {
    const Eigen::Vector3d slope = after / after.dot(frame_.up) - before / before.dot(frame_.up);
    const bool lower_end = stands() || moves[0].norm() > moves[1].norm();
    add_angle(Kind::lean, angle_between(before, after), length,
              heading(lower_end ? Eigen::Vector3d(-slope) : slope));
  }

  void measure_widths(const std::array<double, 2>& widths, bool upright, bool stout) {
    const double diameter = 2 * part_.form.line->radius();
    const double mean = (widths[0] + widths[1]) / 2;
    if (!is_seen(1 + widths[1] - widths[0], diameter)) {
      add_ratio(stout ? Kind::width : Kind::thickness, mean, diameter);
      return;
    }
    const bool open = upright && stout && is_open();
    const Kind low = open ? Kind::foot : upright ? Kind::lower_end : Kind::one_end;
    const Kind high = open ? Kind::rim : upright ? Kind::upper_end : Kind::one_end;
    add_ratio(high, widths[1], diameter);
    add_ratio(low, widths[0], diameter);
  }

  /// Returns whether the part is open above: whether little of it faces up near its upper end.
  bool is_open() const {
    const Range along = range(frame_.up);
    const double from = along.high - rim_share * along.length();
    const Eigen::Vector3d u = frame_.up.unitOrthogonal(), v = frame_.up.cross(u);
    Eigen::AlignedBox2d end;
    double facing = 0;
    for (const std::int32_t t : part_.triangles) {
      double low = std::numeric_limits<double>::infinity();
      for (int k = 0; k < 3; ++k) {
        const Eigen::Vector3d p = rest_.corner(t, k);
        low = std::min(low, frame_.up.dot(p));
        if (frame_.up.dot(p) >= from) end.extend(Eigen::Vector2d(u.dot(p), v.dot(p)));
      }
      if (low >= from) facing += std::max(0.0, area_vector(rest_, t).dot(frame_.up));
    }
    return facing < open_share * end.volume();
  }

  void measure_body() {
    const double departure = departure_from(result_.map);
    if (departure >= deformed * frame_.visible() && measure_taper()) return;
    AffineSplit split = split_affine(result_.map.linear, frame_.up);
    const AffineSplit unslid = split_affine(part_.form.fit->without_slide(result_.map), frame_.up);
    if (unslid.total_stretch() < split.total_stretch()) split = unslid;
    measure_turns(split.turn);
    measure_sizes(split);
    measure_place();
    add(Kind::form, departure / frame_.height, deformed * frame_.visible() / frame_.height);
  }

  /// Returns the largest distance of the surface from an image of itself at rest, less the displacement of
  /// the whole. Across the surface: points may slide within it.
  template <class Image>
  double departure_from(const Image& image) const {
    const Points at_rest = part_.form.marks.on(rest_);
    double departure = 0;
    for (Eigen::Index k = 0; k < marks_.rows(); ++k) {
      const Eigen::Vector3d normal =
          unit_normal(now_, part_.form.marks.triangles[static_cast<std::size_t>(k)]);
      const Eigen::Vector3d place = image(at_rest.row(k).transpose()) + frame_.shift;
      departure = std::max(departure, std::abs(normal.dot(place - marks_.row(k).transpose())));
    }
    return departure;
  }

  /// Measures both ends of a part whose level sections stay alike, and get wider or narrower in proportion to
  /// their height. Returns whether it is such a part; nothing is measured of others.
  bool measure_taper() {
    const Range along = range(frame_.up);
    if (!(along.length() > 0) || part_.form.fit->rank() < 3) return false;
    const TaperMap taper =
        fit_taper(part_.form.marks.on(rest_), marks_.rowwise() - frame_.shift.transpose(), frame_.up, along);
    if (departure_from(taper) >= deformed * frame_.visible()) return false;
    const double width = std::sqrt(range(taper.axes.row(0)).length() * range(taper.axes.row(1)).length());
    std::array<double, 2> factors{};
    for (std::size_t end = 0; end < 2; ++end) {
      const Eigen::Matrix2d& map = taper.ends[end];
      if (std::abs(std::atan2(map(1, 0) - map(0, 1), map.trace())) * width > frame_.visible()) return false;
      const Eigen::Vector2d stretches = Eigen::JacobiSVD<Eigen::Matrix2d>(map).singularValues();
      // The words know one width: what gets narrower one way only has others.
      const bool seen = is_seen(stretches(0), width), both = is_seen(stretches(1), width);
      if (seen != both || (seen && (stretches(0) > 1) != (stretches(1) > 1))) return false;
      factors[end] = std::sqrt(std::max(0.0, map.determinant()));
    }
    const bool open = is_open();
    add_ratio(open ? Kind::rim : Kind::upper_end, factors[1], width);
    add_ratio(open ? Kind::foot : Kind::lower_end, factors[0], width);
    add_ratio(Kind::tallness, taper.stretch, along.length());
    const double at_top = taper.rise + (taper.stretch - 1) * along.length();
    const double rise = taper.rise * at_top <= 0                  ? 0
                        : std::abs(taper.rise) < std::abs(at_top) ? taper.rise
                                                                  : at_top;
    add_place(taper.axes.transpose() * taper.shift + rise * frame_.up);
    return true;
  }

  /// Measures what became of upright lines and level planes.
  void measure_turns(const Eigen::Matrix3d& turn) {
    const Eigen::Vector3d& up = frame_.up;
    const Eigen::Vector3d line = (turn * up).normalized();
    const Eigen::Vector3d normal = (turn.inverse().transpose() * up).normalized();
    const double tall = range(up).length();
    double widest = 0, narrowest = std::numeric_limits<double>::infinity();
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d axis = frame_.level(part_.form.fit->axes().col(k));
      if (axis.norm() < level_cosine) continue;
      const double extent = range(axis.normalized()).length();
      widest = std::max(widest, extent);
      narrowest = std::min(narrowest, extent);
    }
    const bool upright = tall > upright_ratio * narrowest;
    const double lean = angle_between(up, line), tilt = angle_between(up, normal);
    if (upright && lean * tall >= frame_.visible()) {
      const Eigen::Vector3d slope = frame_.level(line);
      add_angle(Kind::lean, lean, tall, heading(stands() ? Eigen::Vector3d(-slope) : slope));
    } else {
      add_angle(Kind::tilt, tilt, widest);
    }
    const Eigen::Vector3d u = up.unitOrthogonal(), v = up.cross(u);
    const double yaw = std::atan2(v.dot(turn * u) - u.dot(turn * v), u.dot(turn * u) + v.dot(turn * v));
    if (2 * widest > tall) add_angle(Kind::turn, std::abs(yaw), widest);
  }

  /// Names the stretches along the axes of a split.
  void measure_sizes(const AffineSplit& split) {
    struct Stretch {
      double factor, extent;
      bool thin = false, upright = false, level = false;
    };
    std::array<Stretch, 3> stretches;
    const Eigen::Vector3d box = part_.high - part_.low;  // longest first
    const bool plate = part_.form.fit->rank() == 2 || box(2) < plate_ratio * box(1);
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d axis = split.axes.col(k);
      const double rise = std::abs(axis.dot(frame_.up));
      stretches[at(k)] = {split.factors(k), range(axis).length(),
                          plate && std::abs(axis.dot(part_.form.fit->axes().col(2))) > along_cosine,
                          rise > along_cosine, rise < level_cosine};
    }
    const auto alike = [&](const Stretch& a, const Stretch& b) {
      return is_seen(a.factor, a.extent) && is_seen(b.factor, b.extent) &&
             std::abs(a.factor - b.factor) <=
                 limit::alike * std::max(std::abs(a.factor - 1), std::abs(b.factor - 1));
    };
    std::sort(stretches.begin(), stretches.end(), [](const Stretch& a, const Stretch& b) {
      return std::pair(a.thin, a.upright) < std::pair(b.thin, b.upright);
    });
    const auto& [first, second, third] = stretches;
    if (alike(first, second) && (alike(second, third) || third.thin)) {
      add_ratio(Kind::size, (first.factor + second.factor) / 2, first.extent);
      if (third.thin && !alike(second, third)) add_ratio(Kind::thickness, third.factor, third.extent);
      return;
    }
    if (alike(first, second) && first.level && second.level) {
      add_ratio(Kind::girth, (first.factor + second.factor) / 2, first.extent);
      add_ratio(third.upright ? Kind::tallness : Kind::width, third.factor, third.extent);
      return;
    }
    for (const Stretch& one : stretches) {
      const bool longest = std::all_of(stretches.begin(), stretches.end(), [&](const Stretch& other) {
        return &other == &one || other.upright || other.thin || one.extent > length_ratio * other.extent;
      });
      const bool alone = std::count_if(stretches.begin(), stretches.end(), [](const Stretch& other) {
                           return !other.upright && !other.thin;
                         }) < 2;
      add_ratio(one.thin            ? Kind::thickness
                : one.upright       ? Kind::tallness
                : longest && !alone ? Kind::length
                                    : Kind::width,
                one.factor, one.extent);
    }
  }

  /// Measures the displacement of the point of the box of the part that moves least.
  void measure_place() {
    const Eigen::Matrix3d axes = part_.form.fit->axes();
    const Eigen::Matrix3d strain = (result_.map.linear - Eigen::Matrix3d::Identity()) * axes;
    const Eigen::Vector3d by = result_.map.to - result_.map.from;
    Eigen::Vector3d place = Eigen::Vector3d::Zero().cwiseMax(part_.low).cwiseMin(part_.high);
    for (int sweep = 0; sweep < sweeps; ++sweep)
      for (int k = 0; k < 3; ++k) {
        const double squared = strain.col(k).squaredNorm();
        if (!(squared > 0)) continue;
        const double step = -strain.col(k).dot(strain * place + by) / squared;
        place(k) = std::clamp(place(k) + step, part_.low(k), part_.high(k));
      }
    add_place(strain * place + by);
  }

  void add_place(const Eigen::Vector3d& moved) {
    const double least = frame_.visible() / frame_.height;
    add(Kind::rise, moved.dot(frame_.up) / frame_.height, least);
    add(Kind::shift, frame_.level(moved).norm() / frame_.height, least, heading(moved));
  }

  const PartAtRest& part_;
  const Shape& rest_;
  const Shape& now_;
  const ObjectFrame& frame_;
  Points marks_;
  PartChanges result_;
};

}  // namespace

double PartChanges::max_seen() const {
  double most = 0;
  for (const SeenChange& one : changes) most = std::max(most, one.seen());
  return most;
}

void leave_out_minor(std::vector<PartChanges>& parts) {
  double most = 0;
  for (const PartChanges& part : parts) most = std::max(most, part.max_seen());
  for (PartChanges& part : parts)
    std::erase_if(part.changes, [least = std::min(part.max_seen(), minor * most)](const SeenChange& one) {
      return one.seen() < least;
    });
}

double ObjectFrame::visible() const {
  return tolerance::visible * diagonal;
}

PartAtRest part_at_rest(const StructuredShape& rest, std::size_t part, std::vector<std::int32_t> triangles) {
  PartAtRest result{part_form(rest, part, triangles, max_form_pieces), std::move(triangles)};
  if (!result.form.fit) return result;
  result.low.setConstant(std::numeric_limits<double>::infinity());
  result.high = -result.low;
  for (const std::int32_t t : result.triangles) {
    result.area += area_vector(rest.shape, t).norm();
    for (int k = 0; k < 3; ++k) {
      const Eigen::Vector3d place =
          result.form.fit->axes().transpose() * (rest.shape.corner(t, k) - result.form.fit->centre());
      result.low = result.low.cwiseMin(place);
      result.high = result.high.cwiseMax(place);
    }
  }
  return result;
}

PartChanges part_changes(const PartAtRest& part, const Shape& rest, const Shape& now,
                         const ObjectFrame& frame) {
  return PartMeasurement(part, rest, now, frame).run();
}

std::string form_noun(const PartAtRest& part, const ObjectFrame& frame) {
  if (!part.form.fit) return "part";
  const Eigen::Vector3d box = part.high - part.low;
  if (is_member(part, frame) && box(0) >= stout_length * part.form.line->radius()) {
    if (std::abs(part.form.line->direction().dot(frame.up)) >= upright_cosine) return "upright";
    return box(1) >= slat_ratio * box(2) ? "slat" : "bar";
  }
  if (box(2) >= plate_ratio * box(1)) return "part";
  if (part.area < frame_share * 2 * box(0) * box(1)) return "frame";
  const double slope = std::abs(part.form.fit->axes().col(2).dot(frame.up));
  return slope >= upright_cosine ? "board" : "panel";
}

}  // namespace stackabilization::detail
