// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/stiffness.h"

#include "stiffness_points.h"

namespace tetradapt::mechanics
{
  namespace
  {
    /** Upper triangle (a <= b) of the cell's node-to-node blocks. */
    template <unsigned int n>
    class CellStiffness
    {
    public:
      void
      compute(const mesh::TetMesh                  &mesh,
              unsigned int                          cell,
              const TangentField                   &tangents,
              const std::vector<mesh::Barycentric> &points)
      {
        blocks.fill(BlockMatrix::Block{});
        const auto         directions = mesh::barycentric_gradients(mesh, cell);
        const double       weight     = mesh::cell_volume(mesh, cell) / points.size();
        const unsigned int degree     = n == 4 ? 1 : 2;
        for (unsigned int q = 0; q < points.size(); ++q)
          {
            std::array<Tensor<1, 3>, n> g;
            mesh::shape_gradients(degree, points[q], directions, g.data());
            const bool has_one
              = points.size() == tangents.points_per_cell() || tangents.points_per_cell() == 1;
            for (unsigned int p = has_one ? q : 0; p < (has_one ? q + 1 : 4); ++p)
              if (tangents.is_full())
                add_full_point(g, tangents.full(cell, p), has_one ? weight : 0.25 * weight);
              else
                add_point(g, tangents.at(cell, p), has_one ? weight : 0.25 * weight);
          }
      }

      const BlockMatrix::Block &
      block(unsigned int a, unsigned int b) const
      {
        return blocks[a * n + b];
      }

    private:
      void
      add_point(const std::array<Tensor<1, 3>, n> &g, const VoigtMatrix &D, double weight)
      {
        for (unsigned int b = 0; b < n; ++b)
          {
            // Columns of D B_b; B_b has three nonzeros a column.
            double       DB[6][3];
            const double gx = weight * g[b][0], gy = weight * g[b][1], gz = weight * g[b][2];
            for (unsigned int i = 0; i < 6; ++i)
              {
                DB[i][0] = D[i][0] * gx + D[i][4] * gz + D[i][5] * gy;
                DB[i][1] = D[i][1] * gy + D[i][3] * gz + D[i][5] * gx;
                DB[i][2] = D[i][2] * gz + D[i][3] * gy + D[i][4] * gx;
              }
            for (unsigned int a = 0; a <= b; ++a)
              {
                BlockMatrix::Block &K = blocks[a * n + b];
                const double        x = g[a][0], y = g[a][1], z = g[a][2];
                for (unsigned int c = 0; c < 3; ++c)
                  {
                    K[c] += x * DB[0][c] + z * DB[4][c] + y * DB[5][c];
                    K[3 + c] += y * DB[1][c] + z * DB[3][c] + x * DB[5][c];
                    K[6 + c] += z * DB[2][c] + y * DB[3][c] + x * DB[4][c];
                  }
              }
          }
      }

      /** K_ab(i, k) = g_a(J) A_iJkL g_b(L) */
      void
      add_full_point(const std::array<Tensor<1, 3>, n> &g,
                     const laws::Tangent           &A,
                     const double                       weight)
      {
        double       full[9][9];
        unsigned int place = 0;
        for (unsigned int a = 0; a < 9; ++a)
          for (unsigned int b = a; b < 9; ++b, ++place)
            full[a][b] = full[b][a] = weight * A[place];
        for (unsigned int b = 0; b < n; ++b)
          {
            double Ag[9][3]; // A_iJkL g_b(L)
            for (unsigned int a = 0; a < 9; ++a)
              for (unsigned int k = 0; k < 3; ++k)
                Ag[a][k] = full[a][3 * k] * g[b][0] + full[a][3 * k + 1] * g[b][1]
                           + full[a][3 * k + 2] * g[b][2];
            for (unsigned int a = 0; a <= b; ++a)
              for (unsigned int i = 0; i < 3; ++i)
                for (unsigned int k = 0; k < 3; ++k)
                  blocks[a * n + b][3 * i + k] += g[a][0] * Ag[3 * i][k]
                                                  + g[a][1] * Ag[3 * i + 1][k]
                                                  + g[a][2] * Ag[3 * i + 2][k];
          }
      }

      std::array<BlockMatrix::Block, n * n> blocks;
    };

    /** Adds one block to entry @p entry of a row, leaving out constrained rows and columns
     * and moving prescribed values to the right-hand side. */
    void
    add_constrained_block(const BlockMatrix::Block &K,
                          bool                      transposed,
                          unsigned int              row,
                          unsigned int              column,
                          unsigned int              entry,
                          const fem::FixedUnknowns &fixed,
                          LinearSystem             &system)
    {
      BlockMatrix::Block &target       = system.matrix.block(entry);
      const unsigned char row_fixed    = fixed.components(row);
      const unsigned char column_fixed = fixed.components(column);
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          {
            const double value   = transposed ? K[3 * j + i] : K[3 * i + j];
            const bool   i_fixed = row_fixed >> i & 1, j_fixed = column_fixed >> j & 1;
            if ((!i_fixed && !j_fixed) || (row == column && i == j))
              target[3 * i + j] += value;
            else if (!i_fixed)
              system.prescribed_forces.local_element(3 * row + i) += value * fixed.value(column, j);
          }
    }

    void
    add_free_block(const BlockMatrix::Block &K, bool transposed, BlockMatrix::Block &target)
    {
      if (transposed)
        for (unsigned int i = 0; i < 9; ++i)
          target[i] += K[3 * (i % 3) + i / 3];
      else
        for (unsigned int i = 0; i < 9; ++i)
          target[i] += K[i];
    }

    /** @p entries: where the matrix has the cell's blocks (see BlockMatrix). */
    template <unsigned int n>
    void
    add_cell(const fem::Space         &space,
             unsigned int              k,
             const CellStiffness<n>   &stiffness,
             const fem::FixedUnknowns &fixed,
             const unsigned int       *entries,
             LinearSystem             &system)
    {
      const unsigned int *nodes     = space.local_nodes_of(k);
      unsigned char       any_fixed = 0;
      for (unsigned int i = 0; i < n; ++i)
        any_fixed |= fixed.components(nodes[i]);
      for (unsigned int a = 0; a < n; ++a)
        if (entries[n * a] != dealii::numbers::invalid_unsigned_int)
          for (unsigned int b = 0; b < n; ++b)
            {
              const auto &K = a <= b ? stiffness.block(a, b) : stiffness.block(b, a);
              if (any_fixed == 0) // almost everywhere
                add_free_block(K, a > b, system.matrix.block(entries[n * a + b]));
              else
                add_constrained_block(
                  K, a > b, nodes[a], nodes[b], entries[n * a + b], fixed, system);
            }
    }

    template <unsigned int n>
    void
    assemble_cells(const fem::Space                &space,
                   const TangentField              &tangents,
                   const fem::FixedUnknowns        &fixed,
                   const std::vector<unsigned int> &cell_entries,
                   LinearSystem                    &system)
    {
      const mesh::TetMesh &mesh   = space.tet_mesh();
      const auto           points = stiffness_points(space.degree());
      CellStiffness<n>     stiffness;
      const unsigned int  *entries = cell_entries.data();
      for (unsigned int k = 0; k < space.touching_cells().size(); ++k, entries += n * n)
        {
          stiffness.compute(mesh, space.touching_cells()[k], tangents, points);
          add_cell(space, k, stiffness, fixed, entries, system);
        }
    }
  } // namespace

  LinearSystem
  assemble(const fem::Space &space, const TangentField &tangents, const fem::FixedUnknowns &fixed)
  {
    std::vector<unsigned int> cell_entries;
    LinearSystem              system(space, &cell_entries);
    if (space.degree() == 1)
      assemble_cells<4>(space, tangents, fixed, cell_entries, system);
    else
      assemble_cells<10>(space, tangents, fixed, cell_entries, system);
    return system;
  }

  Vector
  right_hand_side(const LinearSystem              &system,
                  const fem::Space                &space,
                  const fem::FixedUnknowns        &fixed,
                  const std::vector<Tensor<1, 3>> &forces)
  {
    Vector b(space.vector_layout());
    for (unsigned int row = 0; row < space.n_owned_nodes(); ++row)
      {
        const unsigned int node     = space.field_node(row);
        const auto        &diagonal = system.matrix.block(system.matrix.row_begin(row));
        for (unsigned int c = 0; c < 3; ++c)
          b.local_element(3 * row + c)
            = fixed.is_fixed(row, c)
                ? diagonal[4 * c] * fixed.value(row, c)
                : forces[node][c] - system.prescribed_forces.local_element(3 * row + c);
      }
    return b;
  }
} // namespace tetradapt::mechanics
