// SPDX-License-Identifier: AGPL-3.0-or-later
#include "pairing.h"

#include <numeric>

namespace tetradapt::solve
{
  namespace
  {
    /** Couplings between the sets of nodes so far: squares of Frobenius' norms. */
    struct Couplings
    {
      std::vector<std::size_t>  begin{0};
      std::vector<unsigned int> columns;
      std::vector<double>       squares;
    };

    template <unsigned int n>
    Couplings
    couplings_of(const BlockRows<n, n> &matrix)
    {
      Couplings result;
      for (unsigned int row = 0; row < matrix.n_rows(); ++row)
        {
          for (std::size_t k = matrix.begin[row]; k < matrix.begin[row + 1]; ++k)
            if (matrix.columns[k] != row && matrix.columns[k] < matrix.n_rows())
              {
                const auto &block = matrix.blocks[k];
                result.columns.push_back(matrix.columns[k]);
                result.squares.push_back(
                  std::inner_product(block.begin(), block.end(), block.begin(), 0.));
              }
          result.begin.push_back(result.columns.size());
        }
      return result;
    }

    /** The number of each node's pair. A node without couplings is one of its own if @p
     * keeps_lone, else it gets none. */
    Aggregates
    pair(const Couplings &couplings, const bool keeps_lone)
    {
      const unsigned int n_nodes = couplings.begin.size() - 1;
      Aggregates         pairs;
      pairs.of_node.assign(n_nodes, no_aggregate);
      for (unsigned int node = 0; node < n_nodes; ++node)
        {
          if (pairs.of_node[node] != no_aggregate)
            continue;
          double       strongest    = 0.;
          unsigned int partner      = node;
          bool         has_coupling = false;
          for (std::size_t k = couplings.begin[node]; k < couplings.begin[node + 1]; ++k)
            has_coupling = has_coupling || couplings.squares[k] > 0.;
          for (std::size_t k = couplings.begin[node]; k < couplings.begin[node + 1]; ++k)
            if (pairs.of_node[couplings.columns[k]] == no_aggregate
                && couplings.squares[k] > strongest)
              {
                strongest = couplings.squares[k];
                partner   = couplings.columns[k];
              }
          if (keeps_lone || has_coupling)
            pairs.of_node[node] = pairs.of_node[partner] = pairs.count++;
        }
      return pairs;
    }

    Couplings
    between_pairs(const Couplings &couplings, const Aggregates &pairs)
    {
      std::vector<std::vector<unsigned int>> members(pairs.count);
      for (unsigned int node = 0; node < pairs.of_node.size(); ++node)
        if (pairs.of_node[node] != no_aggregate)
          members[pairs.of_node[node]].push_back(node);
      Couplings                result;
      std::vector<std::size_t> position(pairs.count, ~std::size_t(0));
      for (unsigned int row = 0; row < pairs.count; ++row)
        {
          for (const unsigned int node : members[row])
            for (std::size_t k = couplings.begin[node]; k < couplings.begin[node + 1]; ++k)
              {
                const unsigned int column = pairs.of_node[couplings.columns[k]];
                if (column == row || column == no_aggregate)
                  continue;
                std::size_t &entry = position[column];
                if (entry >= result.columns.size() || entry < result.begin.back())
                  {
                    entry = result.columns.size();
                    result.columns.push_back(column);
                    result.squares.push_back(0.);
                  }
                result.squares[entry] += couplings.squares[k];
              }
          result.begin.push_back(result.columns.size());
        }
      return result;
    }
  } // namespace

  template <unsigned int n>
  Aggregates
  pair_twice(const BlockRows<n, n> &matrix)
  {
    const Couplings           couplings = couplings_of(matrix);
    const Aggregates          pairs     = pair(couplings, false);
    Aggregates                result    = pair(between_pairs(couplings, pairs), true);
    std::vector<unsigned int> of_node(pairs.of_node.size(), no_aggregate);
    for (unsigned int node = 0; node < of_node.size(); ++node)
      if (pairs.of_node[node] != no_aggregate)
        of_node[node] = result.of_node[pairs.of_node[node]];
    result.of_node = std::move(of_node);
    return result;
  }

  template Aggregates
  pair_twice<6>(const BlockRows<6, 6> &);
} // namespace tetradapt::solve
