// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/edges.h"

#include <algorithm>
#include <cstdint>

namespace tetradapt::mesh
{
  namespace
  {
    /** The larger end of an edge and, in the lower half, where it was named: 6 *
     * cell + local edge. */
    using HalfEdge = std::uint64_t;

    constexpr unsigned int
    larger(const HalfEdge half_edge)
    {
      return half_edge >> 32;
    }

    constexpr unsigned int
    slot_of(const HalfEdge half_edge)
    {
      return half_edge & 0xffffffffu;
    }



    /**
     * For every slot, the first slot (in the order of cells) that names the same
     * edge.
     */
    std::vector<unsigned int>
    first_slots(const TetMesh &mesh)
    {
      std::vector<unsigned int> begin(mesh.n_points() + 2, 0);
      for (const auto &cell : mesh.cells)
        for (const auto &[i, j] : edge_vertices)
          ++begin[std::min(cell[i], cell[j]) + 2];
      for (std::size_t i = 2; i < begin.size(); ++i)
        begin[i] += begin[i - 1];

      // begin[v + 1] runs through bucket v while it is filled and ends as the
      // beginning of bucket v + 1.
      std::vector<HalfEdge> half_edges(6 * mesh.cells.size());
      unsigned int          slot = 0;
      for (const auto &cell : mesh.cells)
        for (const auto &[i, j] : edge_vertices)
          half_edges[begin[std::min(cell[i], cell[j]) + 1]++]
            = static_cast<HalfEdge>(std::max(cell[i], cell[j])) << 32 | slot++;

      // In a bucket they come in the order of slots: what a point remembers of the last
      // bucket that named it replaces sorting.
      constexpr unsigned int                   none = dealii::numbers::invalid_unsigned_int;
      std::vector<std::array<unsigned int, 2>> last(mesh.n_points(), {{none, none}});
      std::vector<unsigned int>                first(half_edges.size());
      for (unsigned int v = 0; v < mesh.n_points(); ++v)
        for (unsigned int k = begin[v]; k < begin[v + 1]; ++k)
          {
            auto &[bucket, slot] = last[larger(half_edges[k])];
            if (bucket != v)
              {
                bucket = v;
                slot   = slot_of(half_edges[k]);
              }
            first[slot_of(half_edges[k])] = slot;
          }
      return first;
    }
  } // namespace



  EdgeTable
  build_edges(const TetMesh &mesh)
  {
    std::vector<unsigned int> number = first_slots(mesh);

    EdgeTable table;
    table.cell_edges.resize(mesh.cells.size());
    table.edges.reserve(mesh.cells.size() + mesh.cells.size() / 4 + mesh.points.size());
    unsigned int slot = 0;
    for (std::size_t c = 0; c < mesh.cells.size(); ++c)
      for (unsigned int e = 0; e < 6; ++e, ++slot)
        {
          if (number[slot] == slot)
            {
              const unsigned int a = mesh.cells[c][edge_vertices[e][0]];
              const unsigned int b = mesh.cells[c][edge_vertices[e][1]];
              number[slot]         = table.edges.size();
              table.edges.push_back({{std::min(a, b), std::max(a, b)}});
            }
          else
            number[slot] = number[number[slot]];
          table.cell_edges[c][e] = number[slot];
        }
    table.edges.shrink_to_fit();
    return table;
  }



  EdgeFinder::EdgeFinder(const EdgeTable &table, const unsigned int n_points)
    : begin(n_points + 2, 0), entries(table.edges.size())
  {
    for (const auto &edge : table.edges)
      ++begin[edge[0] + 2];
    for (std::size_t i = 2; i < begin.size(); ++i)
      begin[i] += begin[i - 1];
    for (unsigned int e = 0; e < table.edges.size(); ++e)
      entries[begin[table.edges[e][0] + 1]++] = {{table.edges[e][1], e}};
    for (unsigned int v = 0; v < n_points; ++v)
      std::sort(entries.begin() + begin[v], entries.begin() + begin[v + 1]);
  }



  unsigned int
  EdgeFinder::find(const unsigned int a, const unsigned int b) const
  {
    const unsigned int smaller = std::min(a, b);
    const unsigned int larger  = std::max(a, b);
    if (smaller + 1 >= begin.size())
      return dealii::numbers::invalid_unsigned_int;
    const auto last  = entries.begin() + begin[smaller + 1];
    const auto found = std::lower_bound(entries.begin() + begin[smaller],
                                        last,
                                        larger,
                                        [](const std::array<unsigned int, 2> &entry,
                                           const unsigned int value) { return entry[0] < value; });
    return found != last && (*found)[0] == larger ? (*found)[1]
                                                  : dealii::numbers::invalid_unsigned_int;
  }
} // namespace tetradapt::mesh
