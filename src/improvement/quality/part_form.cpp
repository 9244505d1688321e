#include "improvement/quality/part_form.h"

namespace stackabilization::detail {

namespace {

constexpr int marks_per_form = 240;

}  // namespace

PartForm part_form(const StructuredShape& rest, std::size_t part, const std::vector<std::int32_t>& triangles,
                   std::size_t max_pieces) {
  PartForm form;
  form.marks = marks_on(rest.shape, triangles, marks_per_form);
  if (form.marks.size() == 0) return form;
  form.fit.emplace(form.marks.on(rest.shape));
  form.line = CentreLine::of(rest.structure.parts[part].primitive, rest.shape, triangles, max_pieces);
  return form;
}

}  // namespace stackabilization::detail
