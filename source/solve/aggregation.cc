// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/aggregation.h"

#include <algorithm>
#include <cmath>

namespace tetradapt::solve
{
  namespace
  {
    template <std::size_t size>
    double
    squared_norm(const std::array<double, size> &block)
    {
      double sum = 0.;
      for (const double entry : block)
        sum += entry * entry;
      return sum;
    }

    /** The strong couplings between the nodes of this rank, and how strong they are. */
    struct Graph
    {
      std::vector<std::size_t>  begin{0};
      std::vector<unsigned int> neighbours;
      std::vector<float>        strengths;
    };

    template <unsigned int n>
    Graph
    strong_couplings(const BlockRows<n, n> &matrix, double threshold)
    {
      const unsigned int  n_rows = matrix.n_rows();
      std::vector<double> largest(n_rows, 0.); // square of a row's largest coupling
      for (unsigned int row = 0; row < n_rows; ++row)
        for (std::size_t k = matrix.begin[row]; k < matrix.begin[row + 1]; ++k)
          if (matrix.columns[k] != row)
            largest[row] = std::max(largest[row], squared_norm(matrix.blocks[k]));
      Graph        graph;
      const double least = threshold * threshold;
      for (unsigned int row = 0; row < n_rows; ++row)
        {
          for (std::size_t k = matrix.begin[row]; k < matrix.begin[row + 1]; ++k)
            {
              const unsigned int column = matrix.columns[k];
              if (column == row || column >= n_rows)
                continue;
              const double strength
                = squared_norm(matrix.blocks[k]) / std::min(largest[row], largest[column]);
              if (strength > least)
                {
                  graph.neighbours.push_back(column);
                  graph.strengths.push_back(strength);
                }
            }
          graph.begin.push_back(graph.neighbours.size());
        }
      return graph;
    }

    /** A new aggregate of every node with all its neighbours, where all are free. */
    void
    seed(const Graph &graph, Aggregates &aggregates)
    {
      auto &of_node = aggregates.of_node;
      for (unsigned int node = 0; node < of_node.size(); ++node)
        {
          const std::size_t first = graph.begin[node], last = graph.begin[node + 1];
          bool              is_free = of_node[node] == no_aggregate && first != last;
          for (std::size_t k = first; k < last && is_free; ++k)
            is_free = of_node[graph.neighbours[k]] == no_aggregate;
          if (!is_free)
            continue;
          of_node[node] = aggregates.count;
          for (std::size_t k = first; k < last; ++k)
            of_node[graph.neighbours[k]] = aggregates.count;
          ++aggregates.count;
        }
    }

    /** Nodes next to aggregates join that which they are coupled to most. */
    void
    join(const Graph &graph, Aggregates &aggregates)
    {
      const auto seeded = aggregates.of_node;
      for (unsigned int node = 0; node < seeded.size(); ++node)
        if (seeded[node] == no_aggregate)
          {
            float strongest = 0.;
            for (std::size_t k = graph.begin[node]; k < graph.begin[node + 1]; ++k)
              if (seeded[graph.neighbours[k]] != no_aggregate && graph.strengths[k] > strongest)
                {
                  strongest                = graph.strengths[k];
                  aggregates.of_node[node] = seeded[graph.neighbours[k]];
                }
          }
    }

    /** What is left makes aggregates with its free neighbours. */
    void
    collect_rest(const Graph &graph, Aggregates &aggregates)
    {
      auto &of_node = aggregates.of_node;
      for (unsigned int node = 0; node < of_node.size(); ++node)
        {
          if (of_node[node] != no_aggregate || graph.begin[node] == graph.begin[node + 1])
            continue;
          of_node[node] = aggregates.count;
          for (std::size_t k = graph.begin[node]; k < graph.begin[node + 1]; ++k)
            if (of_node[graph.neighbours[k]] == no_aggregate)
              of_node[graph.neighbours[k]] = aggregates.count;
          ++aggregates.count;
        }
    }

    /** Gram and Schmidt's method, twice, on the columns of @p rows; @p R is such that
     * the columns given are those made times R. */
    template <unsigned int n>
    void
    orthonormalise(std::vector<NodeModes<n> *> &rows, NodeModes<6> &R)
    {
      const auto product = [&](unsigned int a, unsigned int b) {
        double sum = 0.;
        for (const auto *row : rows)
          for (unsigned int i = 0; i < n; ++i)
            sum += (*row)[6 * i + a] * (*row)[6 * i + b];
        return sum;
      };
      R.fill(0.);
      for (unsigned int k = 0; k < 6; ++k)
        {
          const double before = product(k, k);
          for (unsigned int repetition = 0; repetition < 2; ++repetition)
            for (unsigned int l = 0; l < k; ++l)
              {
                const double factor = product(l, k);
                R[6 * l + k] += factor;
                for (auto *row : rows)
                  for (unsigned int i = 0; i < n; ++i)
                    (*row)[6 * i + k] -= factor * (*row)[6 * i + l];
              }
          // Motions about a far axis are translations to all but a small part.
          const double after     = product(k, k);
          const bool   dependent = !(after > 1e-20 * before);
          const double norm      = dependent ? 0. : std::sqrt(after);
          R[6 * k + k]           = norm;
          for (auto *row : rows)
            for (unsigned int i = 0; i < n; ++i)
              (*row)[6 * i + k] = dependent ? 0. : (*row)[6 * i + k] / norm;
        }
    }
  } // namespace

  template <unsigned int n>
  Aggregates
  aggregate(const BlockRows<n, n> &matrix, double threshold)
  {
    const Graph graph = strong_couplings(matrix, threshold);
    Aggregates  aggregates;
    aggregates.of_node.assign(matrix.n_rows(), no_aggregate);
    seed(graph, aggregates);
    join(graph, aggregates);
    collect_rest(graph, aggregates);
    return aggregates;
  }

  template <unsigned int n>
  TentativeProlongation<n>
  tentative_prolongation(const Aggregates &aggregates, const std::vector<NodeModes<n>> &modes)
  {
    TentativeProlongation<n>                 result{modes, {}};
    std::vector<std::vector<NodeModes<n> *>> rows(aggregates.count);
    for (unsigned int node = 0; node < modes.size(); ++node)
      if (aggregates.of_node[node] != no_aggregate)
        rows[aggregates.of_node[node]].push_back(&result.rows[node]);
      else
        result.rows[node].fill(0.);
    result.coarse_modes.resize(aggregates.count);
    for (unsigned int i = 0; i < aggregates.count; ++i)
      orthonormalise<n>(rows[i], result.coarse_modes[i]);
    return result;
  }

  template Aggregates
  aggregate<3>(const BlockRows<3, 3> &, double);
  template Aggregates
  aggregate<6>(const BlockRows<6, 6> &, double);
  template TentativeProlongation<3>
  tentative_prolongation<3>(const Aggregates &, const std::vector<NodeModes<3>> &);
  template TentativeProlongation<6>
  tentative_prolongation<6>(const Aggregates &, const std::vector<NodeModes<6>> &);
} // namespace tetradapt::solve
