// SPDX-License-Identifier: AGPL-3.0-or-later
#include "moves.h"

#include <deal.II/base/numbers.h>

namespace tetradapt::estimate
{
  namespace
  {
    constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;

    /** The two faces of a cell at each of its edges: opposite the other corners. */
    constexpr unsigned int faces_at_edge[6][2] = {{2, 3}, {0, 3}, {1, 3}, {1, 2}, {0, 2}, {0, 1}};

    /** Place on the numbered face of corner @p corner of a cell. */
    unsigned char
    place(const CellFaces   &faces,
          const unsigned int cell,
          const unsigned int face,
          const unsigned int corner)
    {
      unsigned int s = 0;
      while (mesh::face_vertices[face][s] != corner)
        ++s;
      return faces.sides[cell][face].corner[s];
    }
  } // namespace

  TractionMoves::TractionMoves(const mesh::TetMesh         &mesh,
                               const mesh::EdgeTable       &edges,
                               const CellFaces             &faces,
                               const std::vector<FaceLoad> &loads)
  {
    face_components.resize(faces.n_faces);
    for (unsigned int face = 0; face < faces.n_faces; ++face)
      face_components[face] = faces.boundary[face] == none ? 7 : loads[faces.boundary[face]].held;

    const unsigned int        n_edges = edges.edges.size();
    std::vector<unsigned int> begin(n_edges + 1, 0), at(6 * std::size_t(mesh.n_cells()));
    for (const auto &cell : edges.cell_edges)
      for (const unsigned int e : cell)
        ++begin[e];
    for (unsigned int e = 0, sum = 0; e <= n_edges; ++e)
      {
        sum += begin[e];
        begin[e] = sum;
      }
    for (unsigned int cell = mesh.n_cells(); cell-- > 0;)
      for (unsigned int e = 6; e-- > 0;)
        at[--begin[edges.cell_edges[cell][e]]] = 6 * cell + e;

    turns.reserve(at.size());
    ring_begin.assign(1, 0);
    for (unsigned int e = 0; e < n_edges; ++e)
      {
        leaves.clear();
        for (unsigned int k = begin[e]; k < begin[e + 1]; ++k)
          {
            const unsigned int cell = at[k] / 6, edge = at[k] % 6;
            leaves.push_back({cell,
                              edge,
                              {faces.sides[cell][faces_at_edge[edge][0]].face,
                               faces.sides[cell][faces_at_edge[edge][1]].face},
                              false});
          }
        walk(e, mesh, edges, faces);
      }
    leaves.clear();
    sort_rings(mesh.n_cells());
  }

  void
  TractionMoves::walk(const unsigned int     edge,
                      const mesh::TetMesh   &mesh,
                      const mesh::EdgeTable &edges,
                      const CellFaces       &faces)
  {
    // First what begins at the boundary, then what is closed.
    for (const bool open : {true, false})
      for (unsigned int start = 0; start < leaves.size(); ++start)
        {
          if (leaves[start].done)
            continue;
          unsigned int in = 0;
          if (open)
            {
              while (in < 2 && faces.boundary[leaves[start].faces[in]] == none)
                ++in;
              if (in == 2)
                continue;
            }
          unsigned char components = face_components[leaves[start].faces[in]];
          for (unsigned int leaf = start; leaf != none;)
            {
              Leaf &l = leaves[leaf];
              l.done  = true;
              Turn turn;
              turn.cell = l.cell;
              for (unsigned int side = 0; side < 2; ++side)
                {
                  turn.face[side] = faces_at_edge[l.edge][side == 0 ? in : 1 - in];
                  for (unsigned int end = 0; end < 2; ++end)
                    {
                      const unsigned int corner = mesh::edge_vertices[l.edge][end];
                      const unsigned int which
                        = mesh.cells[l.cell][corner] == edges.edges[edge][0] ? 0 : 1;
                      turn.corner[side][which] = place(faces, l.cell, turn.face[side], corner);
                    }
                }
              turns.push_back(turn);
              const unsigned int out = l.faces[1 - in];
              components &= face_components[out];
              leaf = none;
              if (faces.boundary[out] == none)
                for (unsigned int next = 0; next < leaves.size() && leaf == none; ++next)
                  if (!leaves[next].done)
                    for (unsigned int side = 0; side < 2; ++side)
                      if (leaves[next].faces[side] == out)
                        {
                          leaf = next;
                          in   = side;
                        }
            }
          if (components == 0)
            turns.resize(ring_begin.back());
          else
            {
              ring_begin.push_back(turns.size());
              ring_components.push_back(components);
            }
        }
  }

  void
  TractionMoves::sort_rings(const unsigned int n_cells)
  {
    cell_begin.assign(n_cells + 1, 0);
    for (unsigned int ring = 0; ring < n_rings(); ++ring)
      ++cell_begin[turns[ring_begin[ring]].cell];
    for (unsigned int cell = 0, sum = 0; cell <= n_cells; ++cell)
      {
        sum += cell_begin[cell];
        cell_begin[cell] = sum;
      }
    cell_rings.resize(n_rings());
    for (unsigned int ring = n_rings(); ring-- > 0;)
      cell_rings[--cell_begin[turns[ring_begin[ring]].cell]] = ring;
  }
} // namespace tetradapt::estimate
