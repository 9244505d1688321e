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

/// Empty is the identity, so that untransformed coordinates stay as they are to the bit.
using Transform = std::optional<Eigen::Affine3d>;

/// A build item or a component: an object placed somewhere.
struct Placement {
  std::string model;  ///< Entry of the archive that holds the object.
  std::int64_t object = 0;
  Transform transform;
  std::string name;  ///< Part number of a build item; goes before the names of its parts.
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

/// First child element of that name, whatever its namespace prefix.
pugi::xml_node child(pugi::xml_node node, const char* name);

/// The model that the XML text of the archive's entry `entry` describes. Throws InputError naming the place.
Model parse_model(const Source& source, const std::string& entry);

}  // namespace stackabilization::three_mf
