// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/stiffness.h"

namespace tetradapt::mechanics
{
  namespace
  {
    /** Barycentric points of the stiffness quadrature; equal weights. */
    std::vector<mesh::Barycentric>
    stiffness_points(unsigned int degree)
    {
      if (degree == 1)
        return {{{0.25, 0.25, 0.25, 0.25}}};
      // The four-point rule of degree 2 (Hammer and Stroud 1956).
      const double                   a = 0.58541019662496845446, b = 0.13819660112501051518;
      std::vector<mesh::Barycentric> points(4, {{b, b, b, b}});
      for (unsigned int i = 0; i < 4; ++i)
        points[i][i] = a;
      return points;
    }

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
            if (points.size() == tangents.points_per_cell() || tangents.points_per_cell() == 1)
              add_point(g, tangents.at(cell, q), weight);
            else
              for (unsigned int p = 0; p < 4; ++p)
                add_point(g, tangents.at(cell, p), 0.25 * weight);
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

      std::array<BlockMatrix::Block, n * n> blocks;
    };

    /** Adds one block to a row, leaving out constrained rows and columns and
     * moving prescribed values to the right-hand side. */
    void
    add_block(const BlockMatrix::Block     &K,
              bool                          transposed,
              unsigned int                  row_node,
              unsigned int                  column_node,
              unsigned int                  row,
              unsigned int                  column,
              const PrescribedDisplacement &prescribed,
              LinearSystem                 &system)
    {
      BlockMatrix::Block &target       = system.matrix.block(system.matrix.find(row, column));
      const unsigned char row_fixed    = prescribed.fixed[row_node];
      const unsigned char column_fixed = prescribed.fixed[column_node];
      if (row_fixed == 0 && column_fixed == 0) // almost everywhere
        {
          for (unsigned int i = 0; i < 9; ++i)
            target[i] += transposed ? K[3 * (i % 3) + i / 3] : K[i];
          return;
        }
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          {
            const double value   = transposed ? K[3 * j + i] : K[3 * i + j];
            const bool   i_fixed = row_fixed >> i & 1, j_fixed = column_fixed >> j & 1;
            if ((!i_fixed && !j_fixed) || (row == column && i == j))
              target[3 * i + j] += value;
            else if (!i_fixed)
              system.prescribed_forces.local_element(3 * row + i)
                += value * prescribed.values[column_node][j];
          }
    }

    template <unsigned int n>
    void
    add_cell(const DisplacementSpace      &space,
             unsigned int                  cell,
             const CellStiffness<n>       &stiffness,
             const PrescribedDisplacement &prescribed,
             LinearSystem                 &system)
    {
      std::array<unsigned int, n> nodes, local;
      for (unsigned int i = 0; i < n; ++i)
        {
          nodes[i] = space.cell_node(cell, i);
          local[i] = space.local_node(nodes[i]);
        }
      for (unsigned int a = 0; a < n; ++a)
        if (local[a] < space.n_owned_nodes())
          for (unsigned int b = 0; b < n; ++b)
            add_block(a <= b ? stiffness.block(a, b) : stiffness.block(b, a),
                      a > b,
                      nodes[a],
                      nodes[b],
                      local[a],
                      local[b],
                      prescribed,
                      system);
    }

    template <unsigned int n>
    void
    assemble_cells(const DisplacementSpace      &space,
                   const TangentField           &tangents,
                   const PrescribedDisplacement &prescribed,
                   LinearSystem                 &system)
    {
      const mesh::TetMesh &mesh   = space.tet_mesh();
      const auto           points = stiffness_points(space.degree());
      CellStiffness<n>     stiffness;
      for (const unsigned int cell : space.touching_cells())
        {
          stiffness.compute(mesh, cell, tangents, points);
          add_cell(space, cell, stiffness, prescribed, system);
        }
    }
  } // namespace

  LinearSystem
  assemble(const DisplacementSpace      &space,
           const TangentField           &tangents,
           const PrescribedDisplacement &prescribed)
  {
    LinearSystem system(space);
    if (space.degree() == 1)
      assemble_cells<4>(space, tangents, prescribed, system);
    else
      assemble_cells<10>(space, tangents, prescribed, system);
    return system;
  }

  Vector
  right_hand_side(const LinearSystem              &system,
                  const DisplacementSpace         &space,
                  const PrescribedDisplacement    &prescribed,
                  const std::vector<Tensor<1, 3>> &forces)
  {
    Vector b(space.vector_layout());
    for (unsigned int row = 0; row < space.n_owned_nodes(); ++row)
      {
        const unsigned int node     = space.field_node(row);
        const auto        &diagonal = system.matrix.block(system.matrix.find(row, row));
        for (unsigned int c = 0; c < 3; ++c)
          b.local_element(3 * row + c)
            = prescribed.is_fixed(node, c)
                ? diagonal[4 * c] * prescribed.values[node][c]
                : forces[node][c] - system.prescribed_forces.local_element(3 * row + c);
      }
    return b;
  }
} // namespace tetradapt::mechanics
