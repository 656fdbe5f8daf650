// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/rigid_motions.h"
#include "tetradapt/solve/hexahedral_multigrid.h"
#include "tetradapt/solve/trilinos_types.h"

#include "row_builder.h"

#include <deal.II/dofs/dof_tools.h>

namespace tetradapt::solve
{
  namespace
  {
    using dealii::types::global_dof_index;

    SparseMatrix
    assemble(const HexahedralLevel &level)
    {
      const auto      &handler = level.space.dof_handler();
      dealii::IndexSet relevant;
      dealii::DoFTools::extract_locally_relevant_dofs(handler, relevant);
      SparsityPattern pattern(handler.locally_owned_dofs(),
                              handler.locally_owned_dofs(),
                              relevant,
                              level.space.forest().communicator());
      dealii::DoFTools::make_sparsity_pattern(handler, pattern, level.constraints, false);
      pattern.compress();
      SparseMatrix matrix;
      matrix.reinit(pattern);
      level.stiffness->assemble(matrix);
      return matrix;
    }

    /** The owned unknowns, and as ghosts the others of nodes that rows of the matrix name. */
    std::shared_ptr<const dealii::Utilities::MPI::Partitioner>
    layout_of(const SparseMatrix &matrix)
    {
      const auto      &rows  = matrix.trilinos_matrix();
      const auto       owned = matrix.locally_owned_range_indices();
      dealii::IndexSet ghosts(owned.size());
      for (int column = 0; column < rows.NumMyCols(); ++column)
        if (const global_dof_index node = rows.GCID64(column) / 3; !owned.is_element(3 * node))
          ghosts.add_range(3 * node, 3 * node + 3);
      ghosts.compress();
      return std::make_shared<dealii::Utilities::MPI::Partitioner>(owned,
                                                                   ghosts,
                                                                   matrix.get_mpi_communicator());
    }

    /** The matrix in blocks: deal.II numbers the three unknowns of a vertex one after another.
     * Rows are asked of Trilinos, since deal.II's iterators take as long for a row as for a
     * vector. */
    BlockRows<3, 3>
    blocks_of(const SparseMatrix &matrix, const dealii::Utilities::MPI::Partitioner &layout)
    {
      const auto               &rows = matrix.trilinos_matrix();
      std::vector<unsigned int> columns;
      for (int column = 0; column < rows.NumMyCols(); ++column)
        columns.push_back(layout.global_to_local(rows.GCID64(column)));
      BlockRows<3, 3>  blocks;
      RowBuilder<3, 3> builder(blocks,
                               (layout.locally_owned_size() + layout.n_ghost_indices()) / 3);
      for (int row = 0; row < rows.NumMyRows(); ++row)
        {
          int     n_entries = 0;
          int    *indices   = nullptr;
          double *values    = nullptr;
          rows.ExtractMyRowView(row, n_entries, values, indices);
          for (int k = 0; k < n_entries; ++k)
            {
              const unsigned int column                             = columns[indices[k]];
              builder.block(column / 3)[3 * (row % 3) + column % 3] = values[k];
            }
          if (row % 3 == 2)
            builder.end_row();
        }
      return blocks;
    }

    std::vector<NodeModes<3>>
    rigid_modes(const HexahedralLevel &level)
    {
      const HexahedralForest   &forest = level.space.forest();
      const auto               &planes = forest.grid().planes;
      const Point<3>            lower(planes[0].front(), planes[1].front(), planes[2].front());
      const Point<3>            upper(planes[0].back(), planes[1].back(), planes[2].back());
      const auto               &layout = *level.stiffness->vector_layout();
      std::vector<NodeModes<3>> modes(layout.locally_owned_size() / 3);
      HexahedralSpace::Dofs     dofs;
      for (unsigned int cell = 0; cell < forest.cells().size(); ++cell)
        {
          level.space.get_dofs(cell, dofs);
          for (unsigned int v = 0; v < 8; ++v)
            for (unsigned int k = 0; layout.in_local_range(dofs[3 * v]) && k < 6; ++k)
              {
                const Point<3> unit(v & 1, v >> 1 & 1, v >> 2);
                const auto     motion = mechanics::rigid_motion(k,
                                                            forest.cells()[cell].at(unit),
                                                            lower + .5 * (upper - lower),
                                                            .5 * (upper - lower).norm());
                for (unsigned int c = 0; c < 3; ++c)
                  modes[layout.global_to_local(dofs[3 * v]) / 3][6 * c + k]
                    = level.constraints.is_constrained(dofs[3 * v + c]) ? 0. : motion[c];
              }
        }
      return modes;
    }

    /** Rows of the matrix name other unknowns of other ranks than own cells do. */
    class HexahedralAmg : public Preconditioner
    {
    public:
      HexahedralAmg(const HexahedralLevel &level, const SparseMatrix &matrix)
        : input(layout_of(matrix)), output(input),
          amg(make_amg(blocks_of(matrix, *input.get_partitioner()),
                       rigid_modes(level),
                       input.get_partitioner()))
      {
      }
      void
      vmult(Vector &destination, const Vector &source) const override
      {
        input.copy_locally_owned_data_from(source);
        amg->vmult(output, input);
        destination.copy_locally_owned_data_from(output);
      }

    private:
      mutable Vector                  input, output;
      std::unique_ptr<Preconditioner> amg;
    };
  } // namespace

  std::unique_ptr<Preconditioner>
  make_hexahedral_amg(const HexahedralLevel &level)
  {
    return std::make_unique<HexahedralAmg>(level, assemble(level));
  }
} // namespace tetradapt::solve
