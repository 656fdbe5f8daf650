// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mesh_face_table_h
#define tetradapt_mesh_face_table_h

#include "tetradapt/mesh/tet_mesh.h"

namespace tetradapt::mesh
{
  /**
   * Local vertex numbers of a tetrahedron's faces: face i lies opposite vertex
   * i; its normal by the right-hand rule points out of a positive cell.
   */
  constexpr std::array<std::array<unsigned int, 3>, 4> face_vertices{
    {{{1, 2, 3}}, {{0, 3, 2}}, {{0, 1, 3}}, {{0, 2, 1}}}};

  /**
   * All faces of all cells, and the listed boundary faces, sorted so that equal
   * faces (the same three points) follow each other. Linear in the number of
   * cells: faces are put into one bucket a point (their smallest) and sorted
   * there.
   */
  class FaceTable
  {
  public:
    /** One face of one cell, or one listed boundary face. */
    struct Entry
    {
      unsigned int middle, largest; ///< its point numbers; the bucket has the smallest
      unsigned int slot;            ///< 4 * cell + face, or 4 * n_cells + listed face
    };

    /** Point numbers of cells and faces must be valid. */
    explicit FaceTable(const TetMesh &mesh);

    /**
     * Calls @p visit (first, last) for every different triangle, with the range
     * of pointers to its entries in increasing order of their slots.
     */
    template <typename Visitor>
    void
    for_each_triangle(const Visitor &visit) const
    {
      for (std::size_t v = 0; v + 1 < begin.size(); ++v)
        for (unsigned int k = begin[v], next; k < begin[v + 1]; k = next)
          {
            for (next = k + 1; next < begin[v + 1] && entries[next].middle == entries[k].middle
                               && entries[next].largest == entries[k].largest;)
              ++next;
            visit(entries.data() + k, entries.data() + next);
          }
    }

  private:
    std::vector<unsigned int> begin; ///< per point: its first entry
    std::vector<Entry>        entries;
  };

  /**
   * For every cell and each of its faces the cell on the other side, or
   * numbers::invalid_unsigned_int on the boundary. For a finalized mesh.
   */
  std::vector<std::array<unsigned int, 4>>
  cell_neighbors(const TetMesh &mesh);

  /**
   * Numbers the parts of a mesh that hang together across faces.
   * @return one part number a cell, from 0, in the order of their first cells.
   *         Parts that touch in an edge or a point only are different parts.
   */
  std::vector<unsigned int>
  connected_components(const TetMesh &mesh);
} // namespace tetradapt::mesh

#endif
