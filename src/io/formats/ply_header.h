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

/// Bytes of a value.
std::size_t size_of(Scalar type);

struct Property {
  std::string name;
  Scalar type = Scalar::int32;
  std::optional<Scalar> count_type;  ///< Set for lists.
};

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

struct Header {
  std::optional<std::endian> order;  ///< Empty for ascii.
  std::vector<Element> elements;
  std::vector<std::string> part_names;  ///< From comments "part NAME", as this library writes them.

  const Element* find(std::string_view name) const {
    for (const Element& element : elements)
      if (element.name == name) return &element;
    return nullptr;
  }
};

/// Reads the header and leaves the cursor in its last line. Throws InputError naming the line.
Header read_header(TextCursor& cursor);

}  // namespace stackabilization::ply
