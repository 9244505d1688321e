#include "apps/report/page_view.h"

#include <algorithm>
#include <bit>
#include <cstdint>
#include <stdexcept>
#include <vector>

#include "apps/common/json.h"
#include "apps/common/page_files.h"
#include "apps/common/text.h"
#include "stackabilization/io/encodings.h"

namespace stackabilization::apps {

namespace {

/// Vertices and triangles of all designs together: some 10 MB of a page.
constexpr Eigen::Index max_view_numbers = 3'000'000;

/// A file of the editor's page, and the name by which other modules import it here.
struct Module {
  const char *file, *name;
};
constexpr Module modules[] = {{"three/three.core.js", "three/core"},
                              {"three/three.module.js", "three"},
                              {"three/OrbitControls.js", "three/controls"},
                              {"viewer/palettes.js", "viewer/palettes.js"},
                              {"viewer/coarse_index.js", "viewer/coarse_index.js"},
                              {"viewer/gap_surface.js", "viewer/gap_surface.js"},
                              {"viewer/primitive_lines.js", "viewer/primitive_lines.js"},
                              {"viewer/release.js", "viewer/release.js"},
                              {"viewer/mesh_surface.js", "viewer/mesh_surface.js"},
                              {"viewer/stage.js", "viewer/stage.js"},
                              {"viewer/thumbnails.js", "viewer/thumbnails.js"},
                              {"viewer/viewer.js", "viewer/viewer.js"},
                              {"viewer/report_view.js", "viewer/report_view.js"}};

/// Unpacks the modules, says under which names they are found, and starts. It is XML as well.
constexpr const char* loader = R"(
const unpacked = (id) => {
  const bytes = Uint8Array.from(atob(document.getElementById(id).textContent), (letter) => letter.charCodeAt(0));
  return new Response(new Blob([bytes]).stream().pipeThrough(new DecompressionStream('gzip')));
};
addEventListener('DOMContentLoaded', async () => {
  const box = document.getElementById('view-3d');
  try {
    const imports = {}, sources = await unpacked('view-modules').json();
    for (const name of Object.keys(sources))
      imports[name] = URL.createObjectURL(new Blob([sources[name]], { type: 'text/javascript' }));
    const map = document.createElement('script');
    map.type = 'importmap';
    map.textContent = JSON.stringify({ imports });
    document.head.append(map);
    const { showDesigns } = await import('viewer/report_view.js');
    showDesigns(box, await unpacked('view-designs').arrayBuffer());
  } catch (error) {
    box.hidden = true;
    console.warn('no 3-D view: ' + error);
  }
});
)";

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
  return text;
}

std::string module_text(const Module& module) {
  const auto file = page_file(module.file);
  if (!file) throw std::logic_error(std::string("no module ") + module.file);
  const std::string text =
      replaced(without_comments(file->bytes), "from './three.core.js'", "from 'three/core'");
  return replaced(text, "from './", "from 'viewer/");
}

/// Appends numbers as little-endian words of 32 bits.
class Words {
 public:
  explicit Words(std::string bytes) : bytes_(std::move(bytes)) {}
  void add(std::uint32_t word) {
    for (int byte = 0; byte < 4; ++byte) bytes_ += static_cast<char>(word >> (8 * byte) & 0xff);
  }
  void add(const Points& points) {
    for (Eigen::Index row = 0; row < points.rows(); ++row)
      for (int column = 0; column < 3; ++column)
        add(std::bit_cast<std::uint32_t>(static_cast<float>(points(row, column))));
  }
  std::string take() { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// {designs, vertices, triangles} as JSON, padded to words and with its length before it; then the vertices
/// of each design as 32-bit floats, the triangles, and their parts.
std::string designs_bytes(const Shape& rest, const std::vector<ViewedDesign>& designs) {
  Json list = Json::array();
  for (const ViewedDesign& design : designs)
    list.push_back({{"title", design.title},
                    {"stackability", stackability_text(design.measured.value)},
                    {"step", design.measured.f_max},
                    {"direction", to_json(design.direction)}});
  std::string head =
      Json{{"designs", list}, {"vertices", rest.vertex_count()}, {"triangles", rest.triangle_count()}}.dump();
  head.resize((head.size() + 3) / 4 * 4, ' ');
  Words length("");
  length.add(static_cast<std::uint32_t>(head.size()));
  Words words(length.take() + head);
  for (const ViewedDesign& design : designs) words.add(design.vertices);
  for (Eigen::Index t = 0; t < rest.triangle_count(); ++t)
    for (int k = 0; k < 3; ++k) words.add(static_cast<std::uint32_t>(rest.triangles(t, k)));
  for (const std::int32_t part : rest.triangle_part) words.add(static_cast<std::uint32_t>(part));
  return words.take();
}

std::string packed_script(const std::string& id, const std::string& bytes) {
  return "<script type=\"text/plain\" id=\"" + id + "\">" + base64_text(gzip_bytes(bytes)) + "</script>\n";
}

}  // namespace

std::string without_comments(std::string_view module) {
  std::string result;
  for (std::size_t at = 0; at < module.size();) {
    const std::size_t begin = module.find_first_not_of(" \t", at);
    if (begin == std::string_view::npos) break;
    std::size_t end = std::min(module.find('\n', begin), module.size());
    bool drop = begin == end || module.substr(begin, 2) == "//";
    if (module.substr(begin, 2) == "/*") {
      const std::size_t close = module.find("*/", begin + 2);
      const std::size_t after = std::min(module.find('\n', close), module.size());
      drop =
          close != std::string_view::npos &&
          module.substr(close + 2, after - close - 2).find_first_not_of(" \t\r") == std::string_view::npos &&
          module.substr(begin, close - begin).find("@license") == std::string_view::npos;
      if (close != std::string_view::npos) end = after;
    }
    if (!drop) result += std::string(module.substr(begin, end - begin)) + "\n";
    at = end + 1;
  }
  return result;
}

PageView page_view(const Shape& rest, const std::vector<ViewedDesign>& designs) {
  const auto count = static_cast<Eigen::Index>(designs.size());
  if (count < 2 || 3 * count * rest.vertex_count() + 4 * rest.triangle_count() > max_view_numbers) return {};
  Json sources = Json::object();
  for (const Module& module : modules) sources[module.name] = module_text(module);
  PageView view;
  view.head = packed_script("view-modules", sources.dump()) +
              packed_script("view-designs", designs_bytes(rest, designs)) + "<script>" + loader +
              "</script>\n";
  view.element = "<section id=\"view-3d\" class=\"view\" aria-label=\"3-D view\"></section>\n";
  return view;
}

}  // namespace stackabilization::apps
