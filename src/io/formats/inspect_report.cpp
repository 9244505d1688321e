
#include "stackabilization/core/number_text.h"
#include "stackabilization/core/text.h"
#include "stackabilization/io/inspect.h"

namespace stackabilization {

namespace {

std::string counted(std::int64_t count, const char* one, const char* many) {
  return std::to_string(count) + " " + (count == 1 ? one : many);
}

std::string number(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

std::string vector(const Eigen::Vector3d& value, const char* separator) {
  return number(value.x()) + separator + number(value.y()) + separator + number(value.z());
}

std::string with_unit(const std::string& text, Unit unit) {
  const std::string symbol = unit_symbol(unit);
  return symbol.empty() ? text : text + " " + symbol;
}

/// The summary has rounded numbers.
std::string rounded(double value) {
  return significant_text(value, 6);
}

std::string yes_no(bool value) {
  return value ? "yes" : "no";
}

std::string axis_name(Axis axis) {
  return std::string(1, "xyz"[static_cast<int>(axis)]);
}

}  // namespace

std::string brief(const Findings& findings) {
  const Eigen::Vector3d extents = findings.upper - findings.lower;
  std::string text =
      counted(findings.triangles, "triangle", "triangles") + ", " +
      counted(findings.vertices, "vertex", "vertices") + ", " + counted(findings.parts, "part", "parts") +
      ", " +
      with_unit(rounded(extents.x()) + " x " + rounded(extents.y()) + " x " + rounded(extents.z()),
                findings.unit) +
      ", " + (findings.closed ? "closed" : "open");
  const auto add = [&text](std::int64_t count, const char* one, const char* many) {
    if (count > 0) text += ", " + counted(count, one, many);
  };
  add(findings.boundary_edges, "boundary edge", "boundary edges");
  add(findings.non_manifold_edges, "non-manifold edge", "non-manifold edges");
  add(findings.inconsistent_edges, "inconsistently oriented edge", "inconsistently oriented edges");
  add(findings.degenerate_faces, "degenerate face", "degenerate faces");
  add(findings.duplicate_faces, "duplicate face", "duplicate faces");
  add(findings.self_intersections.value_or(0), "self-intersection", "self-intersections");
  if (findings.volume && !findings.oriented_outward) text += ", oriented inwards";
  if (findings.likely_unit)
    text += ", an unlikely size: are these numbers " + unit_symbol(*findings.likely_unit) + "?";
  return text;
}

std::string report(const Findings& findings) {
  std::string text;
  const auto line = [&text](const std::string& label, const std::string& value) {
    constexpr std::size_t column = 24;
    text += label + std::string(column - label.size(), ' ') + value + "\n";
  };
  line("vertices", std::to_string(findings.vertices));
  line("distinct points", std::to_string(findings.distinct_points));
  line("unreferenced vertices", std::to_string(findings.unreferenced_vertices));
  line("triangles", std::to_string(findings.triangles));
  line("degenerate faces", std::to_string(findings.degenerate_faces));
  line("duplicate faces", std::to_string(findings.duplicate_faces));
  line("parts", std::to_string(findings.parts));
  line("components", std::to_string(findings.components));
  line("boundary edges", std::to_string(findings.boundary_edges));
  line("non-manifold edges", std::to_string(findings.non_manifold_edges));
  line("inconsistent edges", std::to_string(findings.inconsistent_edges));
  line("self-intersections",
       findings.self_intersections ? std::to_string(*findings.self_intersections) : "not checked");
  line("closed", yes_no(findings.closed));
  if (findings.volume) {
    line("volume", number(*findings.volume));
    line("oriented outward", yes_no(findings.oriented_outward));
  } else {
    line("volume", "none (not a closed, consistently oriented surface)");
  }
  line("lower corner", vector(findings.lower, " "));
  line("upper corner", vector(findings.upper, " "));
  line("extents", with_unit(vector(findings.upper - findings.lower, " x "), findings.unit));
  line("unit", (findings.unit == Unit::unknown ? "unknown" : unit_symbol(findings.unit)) +
                   (findings.likely_unit
                        ? " (an unlikely size: are these numbers " + unit_symbol(*findings.likely_unit) + "?)"
                        : ""));
  line("likely up axis",
       (findings.likely_up ? axis_name(*findings.likely_up) : "undecided") + " (" + findings.up_reason + ")");
  return text;
}

}  // namespace stackabilization
