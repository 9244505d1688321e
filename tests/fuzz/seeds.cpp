#include "fuzz/seeds.h"

#include <random>

#include "io/formats/zip.h"
#include "stackabilization/improvement/history.h"
#include "stackabilization/io/write.h"
#include "stackabilization/structure/project_file.h"

namespace stackabilization::fuzz {

namespace {

Shape two_parts() {
  Points vertices(4, 3);
  vertices << 0, 0, 0, 1.5, 0, 0, 0, -2e3, 0, 0, 0, 1;
  Triangles triangles(4, 3);
  triangles << 0, 2, 1, 0, 1, 3, 1, 2, 3, 0, 3, 2;
  Shape shape = make_shape(vertices, triangles);
  shape.part_names = {"a", "b"};
  shape.triangle_part = {0, 0, 1, 1};
  return shape;
}

const char* const obj =
    "# c\nmtllib m\no a\nv 0 0 0 1 1 1\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv .5 .2 0\nvt 0 0\nvn 0 0 1\ng b c\ns 1\n"
    "f 1 2 3 4\nf -5/1 -4//1 -3/1/1 \\\n-2 -1\ng\nl 1 2\no d\nf 1 2 5\n";
const char* const off =
    "COFF # c\n5 2 0\n0 0 0 1 1 1\n1 0 0\n1 1 0\n0 1 0\n.5 .2 0\n4 0 1 2 3 0.5\n5 0 1 2 3 4\n";
const char* const ply =
    "ply\r\nformat ascii 1.0\ncomment part a\nobj_info o\nelement vertex 4\nproperty float x\nproperty "
    "double y\n"
    "property list uchar short l\nproperty int z\nelement face 1\nproperty list uint8 int32 vertex_index\n"
    "property int part\nelement edge 1\nproperty uint16 e\nend_header\n0 0 1 7 0\n1 0 0 0\n1 1 2 1 1 0\n0 1 "
    "0 0\n"
    "4 0 1 2 3 0\n5\n";
const char* const three_mf =
    "<model unit='inch' xmlns:p='urn:/production/'><resources><object id='1' name='a'><mesh><vertices>"
    "<vertex x='0' y='0' z='0'/><vertex x='1' y='0' z='0'/><vertex x='0' y='1' z='0'/></vertices><triangles>"
    "<triangle v1='0' v2='1' v3='2'/></triangles></mesh></object><object id='2'><components>"
    "<component objectid='1' transform='-1 0 0 0 2 0 0 0 3 1 2 3'/><component objectid='1' "
    "p:path='/3D/3dmodel.model'/>"
    "</components></object></resources><build><item objectid='2'/></build></model>";
const char* const gltf =
    R"({"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"children":[1],"translation":[1,2,3],)"
    R"("rotation":[0,0,1,0]},{"mesh":0,"scale":[1,-2,3]},{"mesh":0,"matrix":[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1]}],)"
    R"("meshes":[{"name":"t","primitives":[{"attributes":{"POSITION":0},"indices":1,"mode":5}]}],"accessors":[)"
    R"({"bufferView":0,"componentType":5126,"count":4,"type":"VEC3"},)"
    R"({"bufferView":1,"componentType":5121,"count":12,"type":"SCALAR"}],"bufferViews":[)"
    R"({"buffer":0,"byteLength":48,"byteStride":12},{"buffer":0,"byteOffset":48,"byteLength":12}],"buffers":[)"
    R"({"byteLength":60,"uri":"data:application/octet-stream;base64,)"
    R"(AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAAAAAAAAAAAAAAAIA/AAIBAAEDAQIDAAMC"}]})";

const char* const controls =
    "CUBOID\ta\t0 0 0.5\t1 0 0\t0 1 0\t0 0 1\t1\t2\t3\t1\t1\t1\t1\t1\t1\t1\t\r\nFOO 1\r\n"
    "GC\tb\t1.2\t16\t1.5\t2\t0 0 1\t0 0 -1\t0.1\t1.0e-001\t\r\n";
const char* const groups =
    "SYMMETRY\t2\ta\tb\t\r\nPOINTJOINT\t2\ta\tb\t0 0 1\r\nLINEJOINT 2 a b 0 0 0 1 1 1\nJOINT 2 b a 0 0 0\n"
    "SELF_SYMMETRY\ta\t2\t1 0 0\t0 1 0\t\r\nSELF_SYMMETRY\tb\t1\t-6.27744e+066 1 1\r\n";

StructuredShape two_primitives() {
  StructuredShape result{two_parts(), {}};
  OrientedBox box;
  box.half_extents.setOnes();
  Cuboid cuboid = cuboid_of(box);
  result.structure.parts = {{"a", cuboid, {}}, {"b", cuboid, {}}};
  cuboid.corners(0, 0) = 2;
  result.structure.parts[1].primitive = cuboid;
  result.structure.diagonal = 1;
  const Symmetry symmetry;
  result.structure.symmetries = {symmetry};
  result.structure.relations = {
      {.type = RelationType::self_symmetry, .parts = {0}, .symmetry = symmetry, .points = {}},
      {.type = RelationType::line_joint,
       .parts = {0, 1},
       .symmetry = symmetry,
       .points = Points::Identity(2, 3)}};
  return result;
}

Project two_designs() {
  Project project{two_primitives(), {}, {}};
  project.history.nodes.push_back({});
  HistoryNode node;
  node.edits = {{{HandleKind::part, 0, 0}, Move{{1, 2, 3}}, {}},
                {{HandleKind::face, 0, 3}, Scale{0.5, {}}, Falloff::linear},
                {{HandleKind::shape, 0, 0}, Rotate{{0, 0, 1}, 0.5}, {}}};
  node.constraints.keep_extent = Direction(0, 0, 1);
  node.constraints.box_tolerance = 0.5;
  node.constraints.fixed_parts = {1};
  node.constraints.fixed_points = {{1, 2, 3}};
  project.history = apply(project.history, node);
  return project;
}

detail::SearchState two_candidates() {
  const detail::SearchTask task = search_task();
  detail::SearchState state(task.fingerprint, task.directions);
  for (std::size_t queue = 0; queue < task.directions.size(); ++queue) {
    detail::SearchNode root;
    root.queue = static_cast<int>(queue);
    root.direction = root.measured.direction = task.directions[queue];
    state.tree.add(root);
  }
  detail::SearchNode child;
  child.parent = 1;
  child.queue = 1;
  child.direction = child.measured.direction = Eigen::Vector3d(0, 1, 1);
  child.reason = {EditEffect::down, true, 1};
  child.edit = {{HandleKind::face, 0, 2}, Scale{0.9, {}}, Falloff::linear};
  state.tree.add(child);
  child.edit = {{HandleKind::part, 1, 0}, Rotate{{0, 0, 1}, 0.5}, {}};
  state.tree.add(child);
  state.refusals[without_amounts({.cause = RefusalCause::long_extent, .axis = {0, 0.6, -1}})] = 3;
  state.refusals[Refusal{.cause = RefusalCause::symmetry, .part = 1, .relation = 0}] = 2;
  state.refusals[Check{CheckKind::standing}] = 1;
  state.expanded = 1;
  state.evaluated = 4;
  return state;
}

/// Bytes of the target bounds: two that say how numbers are read, and random ones.
std::string triangle_bytes(char numbers, char semantics) {
  std::string bytes = {numbers, semantics};
  std::mt19937 random(static_cast<std::uint32_t>(numbers + 3 * semantics));
  constexpr std::size_t size = 400;
  while (bytes.size() < size) bytes += static_cast<char>(random() & 0xff);
  return bytes;
}

}  // namespace

detail::SearchTask search_task() {
  static const StructuredShape rest = two_primitives();
  return {7,
          {Eigen::Vector3d(0, 0, 1), Eigen::Vector3d(0, 1, 1)},
          {{HandleKind::face, 0, 2}, {HandleKind::part, 1, 0}},
          rest,
          capabilities_of(DeformationKind::controllers)};
}

std::vector<Seed> seeds() {
  std::vector<Seed> all;
  const auto seed = [&all](const char* target, const std::string& name, const std::string& bytes) {
    all.push_back({target, name, bytes});
  };
  const Shape shape = two_parts();
  seed("obj", "written", shape_bytes(shape, Format::obj));
  seed("obj", "odd", obj);
  seed("off", "written", shape_bytes(shape, Format::off));
  seed("off", "odd", off);
  seed("ply", "written", shape_bytes(shape, Format::ply));
  seed("ply", "odd", ply);
  seed("stl", "binary", shape_bytes(shape, Format::stl));
  seed("stl", "ascii", shape_bytes(shape, Format::stl, {{}, Encoding::ascii}));
  seed("three_mf", "written", shape_bytes(shape, Format::three_mf));
  seed("three_mf", "odd", zip({{"3D/3dmodel.model", three_mf}}));
  seed("three_mf_model", "odd", three_mf);
  seed("gltf", "binary", shape_bytes(shape, Format::gltf));
  seed("gltf", "text", gltf);
  seed("labels", "seg", "2\nlabels a b\n1 0\n0 1\n2 1\n3 0\n");
  seed("labels", "names", "leg\nseat\nleg\n# c\nleg\n");
  seed("labels", "numbers", "0\n3\n3\n1\n");
  seed("project", "written", project_text(two_primitives()));
  seed("history", "written", project_text(two_designs()));
  seed("ctrl_grp_files", "controls", controls);
  seed("ctrl_grp_files", "groups", groups);
  seed("seeds", "marked", "leg 0 1\nseat 3 # c\nleg 2\n");
  seed("search_state", "written", detail::text_of(two_candidates(), two_primitives().shape.part_names));
  for (const char* text :
       {"body move 1 -2.5e-3 0", "'left leg'/face=+x rotate 30 about 0 0 1",
        "body/section=3 scale 1.1 linearly", "shape scale 0.5 along 1 0 0", "'a/face=1'/corner=7 move 0 0 1",
        "point=7 move 1 0 0", "wire=2 rotate 5 about 1 1 0"})
    seed("edits", std::to_string(all.size()), text);
  for (const char* text :
       {"measure\na.obj\n--direction\n0\n0\n1\n--threads\n2", "stack\na.obj\n-n\n3\n--within\n2m\n--unit\nm",
        "improve\na.obj\n--target\n0.5\n--time\n1\n-o\nx\n--box-tolerance\n5%",
        "deform\na.json\n--edit\nbody move 1 0 0\n--fix-point\n0\n0\n1",
        "map\na.obj\n--step-degrees=5\n--help", "structure\na.obj\n--primitive\na=cuboid\n--sections\n9",
        "suggest\na.obj\n--keep\na\n--alpha\n0.1", "search\n-\n--format\nstl\n--cone-degrees\n20",
        "validate\na.obj\n--json\n-\n--quiet", "--version"})
    seed("command_line", std::to_string(all.size()), text);
  for (const char numbers : {0, 1, 2})
    for (const char semantics : {0, 1})
      seed("bounds", std::to_string(all.size()), triangle_bytes(numbers, semantics));
  return all;
}

}  // namespace stackabilization::fuzz
