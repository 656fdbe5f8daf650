// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/adapt/gradation.h"

#include <functional>
#include <queue>

namespace tetradapt::adapt
{
  Gradation::Gradation(const mesh::TetMesh &mesh, const mesh::EdgeTable &edges, const double g)
  {
    if (!(g > 0.))
      return;
    first.assign(mesh.n_points() + 1, 0);
    for (const auto &edge : edges.edges)
      for (const unsigned int p : edge)
        ++first[p + 1];
    for (unsigned int p = 0; p < mesh.n_points(); ++p)
      first[p + 1] += first[p];

    neighbours.resize(first.back());
    std::vector<unsigned int> next(first.begin(), first.end() - 1);
    for (const auto &edge : edges.edges)
      {
        const double growth         = g * mesh.points[edge[0]].distance(mesh.points[edge[1]]);
        neighbours[next[edge[0]]++] = {edge[1], growth};
        neighbours[next[edge[1]]++] = {edge[0], growth};
      }
  }



  unsigned int
  Gradation::limit(std::vector<double> &sizes) const
  {
    if (first.empty())
      return 0;
    const unsigned int n_points = first.size() - 1;

    // Only a point that is too small for one of its neighbours can lower
    // anything, so only those start the search: mostly a small part of all.
    using Entry = std::pair<double, unsigned int>;
    std::vector<Entry> start;
    for (unsigned int p = 0; p < n_points; ++p)
      for (unsigned int i = first[p]; i < first[p + 1]; ++i)
        if (sizes[neighbours[i].point] > sizes[p] + neighbours[i].growth)
          {
            start.emplace_back(sizes[p], p);
            break;
          }
    std::priority_queue<Entry, std::vector<Entry>, std::greater<Entry>> queue(std::greater<Entry>(),
                                                                              std::move(start));

    std::vector<bool> lowered(n_points, false);
    unsigned int      n_lowered = 0;
    while (!queue.empty())
      {
        const auto [size, p] = queue.top();
        queue.pop();
        if (size > sizes[p])
          continue; // lowered again after it was queued
        for (unsigned int i = first[p]; i < first[p + 1]; ++i)
          {
            const unsigned int q     = neighbours[i].point;
            const double       bound = size + neighbours[i].growth;
            if (bound < sizes[q])
              {
                sizes[q] = bound;
                queue.emplace(bound, q);
                if (!lowered[q])
                  {
                    lowered[q] = true;
                    ++n_lowered;
                  }
              }
          }
      }
    return n_lowered;
  }
} // namespace tetradapt::adapt
