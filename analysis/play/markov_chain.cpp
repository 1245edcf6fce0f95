#include <folk/analysis/play/markov_chain.h>

#include <boost/graph/compressed_sparse_row_graph.hpp>
#include <boost/graph/strong_components.hpp>

#include <utility>

namespace folk {

ChainClasses classes_of(const MarkovChain& chain) {
  using Graph = boost::compressed_sparse_row_graph<boost::directedS>;
  std::vector<std::pair<std::size_t, std::size_t>> edges;
  for (std::size_t i = 0; i < chain.size(); ++i)
    for (std::size_t o = 0; o < 4; ++o)
      if (chain[i].probability[o] > 0) edges.emplace_back(i, chain[i].next[o]);
  const Graph graph(boost::edges_are_unsorted, edges.begin(), edges.end(), chain.size());
  ChainClasses classes;
  classes.of.resize(chain.size());
  const auto count = boost::strong_components(
      graph, boost::make_iterator_property_map(classes.of.begin(), boost::get(boost::vertex_index, graph)));
  classes.members.resize(count);
  classes.recurrent.assign(count, true);
  for (std::size_t i = 0; i < chain.size(); ++i) {
    classes.members[classes.of[i]].push_back(i);
    for (std::size_t o = 0; o < 4; ++o)
      if (chain[i].probability[o] > 0 && classes.of[chain[i].next[o]] != classes.of[i])
        classes.recurrent[classes.of[i]] = false;
  }
  return classes;
}

}  // namespace folk
