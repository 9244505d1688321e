#include "io/formats/ply_header.h"

#include <map>
#include <utility>

namespace stackabilization::ply {

namespace {

std::optional<Scalar> scalar_named(std::string_view name) {
  static const std::map<std::string_view, Scalar> names = {
      {"char", Scalar::int8},      {"int8", Scalar::int8},       {"uchar", Scalar::uint8},
      {"uint8", Scalar::uint8},    {"short", Scalar::int16},     {"int16", Scalar::int16},
      {"ushort", Scalar::uint16},  {"uint16", Scalar::uint16},   {"int", Scalar::int32},
      {"int32", Scalar::int32},    {"uint", Scalar::uint32},     {"uint32", Scalar::uint32},
      {"float", Scalar::float32},  {"float32", Scalar::float32}, {"double", Scalar::float64},
      {"float64", Scalar::float64}};
  const auto found = names.find(name);
  if (found == names.end()) return std::nullopt;
  return found->second;
}

class HeaderReader {
 public:
  explicit HeaderReader(TextCursor& cursor) : cursor_(cursor) {}

  Header read() {
    if (!cursor_.next_line() || cursor_.token() != "ply") cursor_.fail("expected 'ply' in the first line");
    for (;;) {
      if (!cursor_.next_line()) cursor_.fail("expected 'end_header', found the end of the file");
      const std::string_view keyword = cursor_.token();
      if (keyword == "end_header") break;
      read_line(keyword);
    }
    if (!has_format_) cursor_.fail("expected a line 'format ...' in the header");
    return std::move(header_);
  }

 private:
  void read_line(std::string_view keyword) {
    if (keyword == "format")
      read_format();
    else if (keyword == "element")
      read_element();
    else if (keyword == "property")
      read_property();
    else if (keyword == "comment") {
      if (cursor_.token() != "part") return;
      header_.part_names.push_back(cursor_.rest_of_line());
      cursor_.require_utf8(header_.part_names.back());
    } else if (keyword != "obj_info" && !keyword.empty())
      cursor_.fail_expected("a header keyword of PLY", keyword);
  }

  void read_format() {
    const std::string_view format = cursor_.token();
    if (format == "binary_little_endian")
      header_.order = std::endian::little;
    else if (format == "binary_big_endian")
      header_.order = std::endian::big;
    else if (format != "ascii")
      cursor_.fail_expected("ascii, binary_little_endian or binary_big_endian", format);
    has_format_ = true;
  }

  void read_element() {
    Element element;
    element.name = cursor_.token();
    element.count = cursor_.integer("the number of elements");
    if (element.count < 0) cursor_.fail("expected a number of elements that is not negative");
    header_.elements.push_back(element);
  }

  Scalar read_type() {
    const std::string_view name = cursor_.token();
    const std::optional<Scalar> type = scalar_named(name);
    if (!type) cursor_.fail_expected("a type of PLY such as float or uchar", name);
    return *type;
  }

  void read_property() {
    if (header_.elements.empty()) cursor_.fail("expected an element before its properties");
    Property property;
    TextCursor ahead = cursor_;
    if (ahead.token() == "list") {
      cursor_.token();
      property.count_type = read_type();
    }
    property.type = read_type();
    property.name = cursor_.token();
    header_.elements.back().properties.push_back(property);
  }

  TextCursor& cursor_;
  Header header_;
  bool has_format_ = false;
};

}  // namespace

std::size_t size_of(Scalar type) {
  switch (type) {
    case Scalar::int8:
    case Scalar::uint8:
      return 1;
    case Scalar::int16:
    case Scalar::uint16:
      return 2;
    case Scalar::float64:
      return 8;
    default:
      return 4;
  }
}

Header read_header(TextCursor& cursor) {
  return HeaderReader(cursor).read();
}

}  // namespace stackabilization::ply
