#include "stackabilization/structure/seeds.h"

#include <algorithm>

#include "stackabilization/core/errors.h"
#include "stackabilization/core/text.h"
#include "stackabilization/io/read_file.h"

namespace stackabilization {

namespace {

PartSeeds& seeds_of(std::vector<PartSeeds>& parts, const std::string& name) {
  const auto known =
      std::find_if(parts.begin(), parts.end(), [&](const PartSeeds& part) { return part.name == name; });
  if (known != parts.end()) return *known;
  parts.push_back({name, {}});
  return parts.back();
}

}  // namespace

std::vector<PartSeeds> parse_seeds(std::string_view text, const std::string& name, const Shape& shape) {
  TextCursor cursor({text, name});
  std::vector<PartSeeds> parts;
  std::vector<bool> seeded(static_cast<std::size_t>(shape.triangle_count()));
  while (cursor.next_content_line()) {
    const std::string part(cursor.token());
    cursor.require_utf8(part);
    std::string_view token = cursor.token();
    if (token.empty()) cursor.fail("expected a part and its triangles, found " + in_quotes(part) + " alone");
    PartSeeds& seeds = seeds_of(parts, part);
    for (; !token.empty(); token = cursor.token()) {
      const std::optional<std::int64_t> triangle = parse_integer(token);
      if (!triangle || *triangle < 0 || *triangle >= shape.triangle_count())
        cursor.fail("expected a triangle between 0 and " + std::to_string(shape.triangle_count() - 1) +
                    ", found " + in_quotes(token));
      const auto index = static_cast<std::size_t>(*triangle);
      if (seeded[index]) cursor.fail("triangle " + std::to_string(*triangle) + " is listed already");
      seeded[index] = true;
      seeds.triangles.push_back(static_cast<std::int32_t>(*triangle));
    }
  }
  if (parts.empty()) throw InputError(name + ": expected parts with their triangles, found none");
  return parts;
}

std::vector<PartSeeds> read_seeds(const std::filesystem::path& path, const Shape& shape) {
  return parse_seeds(read_file(path), path.string(), shape);
}

}  // namespace stackabilization
