// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/face_table.h"

#include <algorithm>
#include <cstdint>
#include <numeric>

namespace tetradapt::mesh
{
  namespace
  {
    std::array<unsigned int, 3>
    sorted(unsigned int a, unsigned int b, unsigned int c)
    {
      if (a > b)
        std::swap(a, b);
      if (b > c)
        std::swap(b, c);
      if (a > b)
        std::swap(a, b);
      return {{a, b, c}};
    }



    /** Calls @p visit with the sorted vertices of every entry, in the order of slots. */
    template <typename Visitor>
    void
    for_each_slot(const TetMesh &mesh, const Visitor &visit)
    {
      for (const auto &cell : mesh.cells)
        for (const auto &face : face_vertices)
          visit(sorted(cell[face[0]], cell[face[1]], cell[face[2]]));
      for (const BoundaryFace &face : mesh.faces)
        visit(sorted(face.vertices[0], face.vertices[1], face.vertices[2]));
    }
    std::uint64_t
    key(const FaceTable::Entry &entry)
    {
      return std::uint64_t(entry.middle) << 32 | entry.largest;
    }



    /** Sorts entries that come in the order of their slots. Buckets are small, and most have
     * what insertion sorts fastest. */
    void
    sort_bucket(FaceTable::Entry *const first, FaceTable::Entry *const last)
    {
      constexpr std::ptrdiff_t largest = 48;
      if (last - first > largest)
        return std::stable_sort(first,
                                last,
                                [](const FaceTable::Entry &a, const FaceTable::Entry &b) {
                                  return key(a) < key(b);
                                });
      for (FaceTable::Entry *next = first; next < last; ++next)
        {
          const FaceTable::Entry entry  = *next;
          const std::uint64_t    number = key(entry);
          FaceTable::Entry      *place  = next;
          for (; place > first && number < key(place[-1]); --place)
            *place = place[-1];
          *place = entry;
        }
    }
  } // namespace



  FaceTable::FaceTable(const TetMesh &mesh)
    : begin(mesh.n_points() + 2, 0), entries(4 * mesh.cells.size() + mesh.faces.size())
  {
    for_each_slot(mesh, [&](const std::array<unsigned int, 3> &v) { ++begin[v[0] + 2]; });
    for (std::size_t i = 2; i < begin.size(); ++i)
      begin[i] += begin[i - 1];

    // begin[v + 1] runs through bucket v while it is filled and ends as the
    // beginning of bucket v + 1.
    unsigned int slot = 0;
    for_each_slot(mesh, [&](const std::array<unsigned int, 3> &v) {
      entries[begin[v[0] + 1]++] = {v[1], v[2], slot++};
    });
    begin.pop_back();

    for (std::size_t v = 0; v + 1 < begin.size(); ++v)
      sort_bucket(entries.data() + begin[v], entries.data() + begin[v + 1]);
  }



  std::vector<std::array<unsigned int, 4>>
  cell_neighbors(const TetMesh &mesh)
  {
    constexpr unsigned int                   none = dealii::numbers::invalid_unsigned_int;
    std::vector<std::array<unsigned int, 4>> neighbors(mesh.cells.size(),
                                                       {{none, none, none, none}});
    const std::size_t                        n_slots = 4 * mesh.cells.size();
    FaceTable(mesh).for_each_triangle(
      [&](const FaceTable::Entry *first, const FaceTable::Entry *last) {
        if (last - first < 2 || first[1].slot >= n_slots)
          return;
        neighbors[first[0].slot / 4][first[0].slot % 4] = first[1].slot / 4;
        neighbors[first[1].slot / 4][first[1].slot % 4] = first[0].slot / 4;
      });
    return neighbors;
  }



  std::vector<unsigned int>
  connected_components(const TetMesh &mesh)
  {
    // Trees of cells that hang together; a root is the first cell of its tree.
    std::vector<unsigned int> parent(mesh.cells.size());
    std::iota(parent.begin(), parent.end(), 0u);
    const auto root = [&](unsigned int cell) {
      while (parent[cell] != cell)
        cell = parent[cell] = parent[parent[cell]];
      return cell;
    };
    const std::size_t n_slots = 4 * mesh.cells.size();
    FaceTable(mesh).for_each_triangle(
      [&](const FaceTable::Entry *first, const FaceTable::Entry *last) {
        if (last - first < 2 || first[1].slot >= n_slots)
          return;
        const unsigned int a = root(first[0].slot / 4), b = root(first[1].slot / 4);
        parent[std::max(a, b)] = std::min(a, b);
      });
    std::vector<unsigned int> part(mesh.cells.size());
    unsigned int              n_parts = 0;
    for (unsigned int cell = 0; cell < part.size(); ++cell)
      part[cell] = parent[cell] == cell ? n_parts++ : part[root(cell)];
    return part;
  }
} // namespace tetradapt::mesh
