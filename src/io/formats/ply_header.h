#pragma once

#include <bit>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "stackabilization/core/text.h"

namespace stackabilization::ply {

enum class Scalar { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Returns the number of bytes of a value.
std::size_t size_of(Scalar type);

/// A property of an element.
struct Property {
  std::string name;
  Scalar type = Scalar::int32;
  std::optional<Scalar> count_type;  ///< type of the count; set for lists
};

/// An element: a table of `count` rows of properties.
struct Element {
  std::string name;
  std::int64_t count = 0;
  std::vector<Property> properties;

  static constexpr std::size_t absent = std::string::npos;
  std::size_t find(std::string_view property) const {
    for (std::size_t i = 0; i < properties.size(); ++i)
      if (properties[i].name == property) return i;
    return absent;
  }
};

/// Header of a PLY file.
struct Header {
  std::optional<std::endian> order;  ///< byte order; empty for ascii
  std::vector<Element> elements;
  std::vector<std::string> part_names;  ///< from comments "part NAME", which this library writes

  const Element* find(std::string_view name) const {
    for (const Element& element : elements)
      if (element.name == name) return &element;
    return nullptr;
  }
};

/// Reads the header. Afterwards the cursor is in the last line of the header. Throws InputError with the
/// line.
Header read_header(TextCursor& cursor);

}  // namespace stackabilization::ply
