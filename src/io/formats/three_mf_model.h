#pragma once

#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <map>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <vector>

#include "stackabilization/core/shape.h"
#include "stackabilization/core/text.h"

namespace stackabilization::three_mf {

struct UnitName {
  const char* name;
  Unit unit;
};
inline constexpr std::array<UnitName, 6> unit_names = {{{"micron", Unit::micrometre},
                                                        {"millimeter", Unit::millimetre},
                                                        {"centimeter", Unit::centimetre},
                                                        {"meter", Unit::metre},
                                                        {"inch", Unit::inch},
                                                        {"foot", Unit::foot}}};

/// Transform of a placement. Empty: the identity, so that coordinates without transform are not rounded.
using Transform = std::optional<Eigen::Affine3d>;

/// A build item or a component: a placed object.
struct Placement {
  std::string model;  ///< entry of the archive that contains the object
  std::int64_t object = 0;
  Transform transform;
  /// Part number of a build item; prefix of the names of its parts.
  std::string name;
};

struct Object {
  std::string name;
  std::vector<Eigen::Vector3d> vertices;
  std::vector<std::array<std::int32_t, 3>> triangles;
  std::vector<Placement> components;
};

struct Model {
  Unit unit = Unit::millimetre;
  std::map<std::int64_t, Object> objects;
  std::vector<Placement> items;
};

/// Returns the first child element with that name and any namespace prefix.
pugi::xml_node child(pugi::xml_node node, const char* name);

/// Parses the XML text of the archive's entry `entry`. Throws InputError with the place.
Model parse_model(const Source& source, const std::string& entry);

}  // namespace stackabilization::three_mf
