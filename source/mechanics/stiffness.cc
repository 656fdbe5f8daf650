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
                     const laws::Tangent               &A,
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

    Tensor<2, 3>
    tensor_of(const BlockMatrix::Block &block)
    {
      Tensor<2, 3> result;
      for (unsigned int i = 0; i < 9; ++i)
        result[i / 3][i % 3] = block[i];
      return result;
    }

    /** The projector on what is free at a node. */
    Tensor<2, 3>
    free_directions(const fem::FixedUnknowns &fixed, const unsigned int node)
    {
      Tensor<2, 3> result;
      for (unsigned int c = 0; c < 3; ++c)
        {
          Tensor<1, 3> axis;
          axis[c]   = 1.;
          result[c] = fixed.free_part(node, axis);
        }
      return result;
    }

    /** What is prescribed at a node, zero elsewhere. */
    Tensor<1, 3>
    prescribed_value(const fem::FixedUnknowns &fixed, const unsigned int node)
    {
      if (fixed.components(node) == fem::FixedUnknowns::is_inclined)
        return fixed.inclined_at(node).value;
      Tensor<1, 3> result;
      for (unsigned int c = 0; c < 3; ++c)
        if (fixed.is_fixed(node, c))
          result[c] = fixed.value(node, c);
      return result;
    }

    /** The same as add_constrained_block() where a node of the two is inclined. A node's own
     * block is added whole: build_in_inclined() does the rest. */
    void
    add_inclined_block(const BlockMatrix::Block &K,
                       bool                      transposed,
                       unsigned int              row,
                       unsigned int              column,
                       unsigned int              entry,
                       const fem::FixedUnknowns &fixed,
                       LinearSystem             &system)
    {
      Tensor<2, 3> block = tensor_of(K);
      if (transposed)
        block = transpose(block);
      const Tensor<1, 3> force = block * prescribed_value(fixed, column);
      for (unsigned int i = 0; i < 3; ++i)
        system.prescribed_forces.local_element(3 * row + i) += force[i];
      if (row != column)
        block = free_directions(fixed, row) * block * free_directions(fixed, column);
      for (unsigned int i = 0; i < 9; ++i)
        system.matrix.block(entry)[i] += block[i / 3][i % 3];
    }

    void
    build_in_inclined(const fem::FixedUnknowns &fixed, LinearSystem &system)
    {
      for (const fem::InclinedNode &inclined : fixed.inclined())
        if (inclined.node < system.matrix.n_rows())
          fem::build_in(inclined.held, system.matrix.block(system.matrix.row_begin(inclined.node)));
    }

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
      if (row_fixed == fem::FixedUnknowns::is_inclined
          || column_fixed == fem::FixedUnknowns::is_inclined)
        return add_inclined_block(K, transposed, row, column, entry, fixed, system);
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
    void
    add_springs(const SpringMatrix<double> &springs,
                const fem::FixedUnknowns   &fixed,
                LinearSystem               &system)
    {
      const BlockMatrix &matrix = system.matrix;
      for (std::size_t k = 0; k < springs.rows().size(); ++k)
        for (std::size_t spring = springs.row_begin(k); spring < springs.row_begin(k + 1); ++spring)
          {
            // Both nodes are of one cell, so that the entry is there.
            const unsigned int row = springs.rows()[k], column = springs.column(spring);
            std::size_t        entry = matrix.row_begin(row);
            while (matrix.column(entry) != column)
              ++entry;
            add_constrained_block(springs.block(spring), false, row, column, entry, fixed, system);
          }
    }
  } // namespace

  LinearSystem
  assemble(const fem::Space           &space,
           const TangentField         &tangents,
           const fem::FixedUnknowns   &fixed,
           const SpringMatrix<double> *springs)
  {
    std::vector<unsigned int> cell_entries;
    LinearSystem              system(space, &cell_entries);
    if (space.degree() == 1)
      assemble_cells<4>(space, tangents, fixed, cell_entries, system);
    else
      assemble_cells<10>(space, tangents, fixed, cell_entries, system);
    if (springs != nullptr)
      add_springs(*springs, fixed, system);
    build_in_inclined(fixed, system);
    return system;
  }

  Vector
  right_hand_side(const LinearSystem       &system,
                  const fem::Space         &space,
                  const fem::FixedUnknowns &fixed,
                  const Vector             &forces)
  {
    Vector b(space.vector_layout());
    for (unsigned int row = 0; row < space.n_owned_nodes(); ++row)
      {
        const auto &diagonal = system.matrix.block(system.matrix.row_begin(row));
        for (unsigned int c = 0; c < 3; ++c)
          b.local_element(3 * row + c)
            = fixed.is_fixed(row, c) ? diagonal[4 * c] * fixed.value(row, c)
                                     : forces.local_element(3 * row + c)
                                         - system.prescribed_forces.local_element(3 * row + c);
      }
    for (const fem::InclinedNode &inclined : fixed.inclined())
      if (inclined.node < space.n_owned_nodes())
        {
          Tensor<1, 3> force;
          for (unsigned int c = 0; c < 3; ++c)
            force[c] = b.local_element(3 * inclined.node + c);
          const auto &own = system.matrix.block(system.matrix.row_begin(inclined.node));
          force += tensor_of(own) * inclined.value - inclined.held * force;
          for (unsigned int c = 0; c < 3; ++c)
            b.local_element(3 * inclined.node + c) = force[c];
        }
    return b;
  }
} // namespace tetradapt::mechanics
