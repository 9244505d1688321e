#include "stackabilization/structure/relation_graph.h"

#include <algorithm>
#include <boost/graph/adjacency_list.hpp>
#include <boost/graph/connected_components.hpp>
#include <boost/graph/graphviz.hpp>
#include <set>
#include <sstream>

namespace stackabilization {

namespace {

/// Edges carry the row of their relation.
using Graph = boost::adjacency_list<boost::vecS, boost::vecS, boost::undirectedS, boost::no_property,
                                    boost::property<boost::edge_index_t, int>>;

Graph graph_of(const Structure& structure) {
  Graph graph(structure.parts.size());
  for (std::size_t r = 0; r < structure.relations.size(); ++r) {
    const std::vector<int>& parts = structure.relations[r].parts;
    boost::add_edge(static_cast<std::size_t>(parts.front()), static_cast<std::size_t>(parts.back()),
                    static_cast<int>(r), graph);
  }
  return graph;
}

std::string edge_style(RelationType type) {
  switch (type) {
    case RelationType::symmetry:
      return "color=\"black:invis:black\"";
    case RelationType::self_symmetry:
      return "style=dotted";
    case RelationType::point_joint:
      return "color=green";
    case RelationType::line_joint:
      return "color=red";
  }
  return {};
}

}  // namespace

struct RelationGraph::Data {
  Graph graph;
  std::vector<std::vector<int>> incident;  ///< per part
  std::vector<std::vector<int>> parts;     ///< per relation
};

RelationGraph::RelationGraph(const Structure& structure) {
  auto data = std::make_shared<Data>();
  data->graph = graph_of(structure);
  data->incident.resize(structure.parts.size());
  for (const Relation& relation : structure.relations) data->parts.push_back(relation.parts);
  const auto index = boost::get(boost::edge_index, data->graph);
  for (std::size_t part = 0; part < structure.parts.size(); ++part) {
    std::set<std::pair<RelationType, int>> rows;  // a loop is listed at both of its ends
    for (const auto& edge : boost::make_iterator_range(boost::out_edges(part, data->graph)))
      rows.emplace(structure.relations[static_cast<std::size_t>(index[edge])].type, index[edge]);
    for (const auto& [type, row] : rows) data->incident[part].push_back(row);
  }
  data_ = std::move(data);
}

const std::vector<int>& RelationGraph::incident(int part) const {
  return data_->incident[static_cast<std::size_t>(part)];
}

int RelationGraph::opposite(int relation, int part) const {
  const std::vector<int>& parts = data_->parts[static_cast<std::size_t>(relation)];
  return parts.front() == part ? parts.back() : parts.front();
}

std::vector<int> RelationGraph::neighbours(int part) const {
  std::set<int> found;
  for (const auto& node :
       boost::make_iterator_range(boost::adjacent_vertices(static_cast<std::size_t>(part), data_->graph)))
    found.insert(static_cast<int>(node));
  found.erase(part);
  return {found.begin(), found.end()};
}

std::vector<int> RelationGraph::components() const {
  std::vector<int> component(data_->incident.size());
  if (!component.empty()) boost::connected_components(data_->graph, component.data());
  return component;
}

std::string graphviz(const Structure& structure) {
  const Graph graph = graph_of(structure);
  const auto index = boost::get(boost::edge_index, graph);
  std::ostringstream text;
  text.imbue(std::locale::classic());
  boost::write_graphviz(
      text, graph,
      [&](std::ostream& out, std::size_t node) {
        const Part& part = structure.parts[node];
        out << "[label=" << boost::escape_dot_string(part.name)
            << " shape=" << (std::holds_alternative<Cuboid>(part.primitive) ? "box" : "ellipse") << "]";
      },
      [&](std::ostream& out, const Graph::edge_descriptor& edge) {
        out << "[" << edge_style(structure.relations[static_cast<std::size_t>(index[edge])].type) << "]";
      });
  return text.str();
}

}  // namespace stackabilization
