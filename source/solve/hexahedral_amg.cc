// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/rigid_motions.h"
#include "tetradapt/solve/hexahedral_multigrid.h"
#include "tetradapt/solve/trilinos_types.h"

#include <Epetra_FECrsMatrix.h>
#include <Teuchos_ParameterList.hpp>
#include <ml_MultiLevelPreconditioner.h>

#include <algorithm>

namespace tetradapt::solve
{
  namespace
  {
    /** What trilinos numbers rows with. */
    using GlobalIndex
      = std::conditional_t<sizeof(dealii::types::global_dof_index) == 8, long long, int>;

    /** Blocks of 3 x 3 on the local nodes: this rank's share of the matrix. */
    struct LocalBlocks
    {
      std::vector<std::size_t>           begin;
      std::vector<unsigned int>          columns;
      std::vector<std::array<double, 9>> values;
    };

    /** The nodes that the corners of a cell are made of. */
    struct CellParts
    {
      struct Part
      {
        unsigned int node, corner;
        double       weight;
      };
      void
      reinit(const HexahedralSpace &space, const unsigned int cell)
      {
        parts.clear();
        for (unsigned int v = 0; v < 8; ++v)
          space.expand(space.nodes(cell)[v], [&](unsigned int node, double weight) {
            parts.push_back({node, v, weight});
          });
      }
      std::vector<Part> parts;
    };

    LocalBlocks
    assemble(const HexahedralLevel &level)
    {
      const HexahedralSpace     &space   = level.space;
      const unsigned int         n_cells = level.forest.cells().size();
      std::vector<std::uint64_t> pairs;
      CellParts                  cell_parts;
      for (unsigned int cell = 0; cell < n_cells; ++cell)
        {
          cell_parts.reinit(space, cell);
          for (const auto &a : cell_parts.parts)
            for (const auto &b : cell_parts.parts)
              pairs.push_back(std::uint64_t(a.node) << 32 | b.node);
        }
      std::sort(pairs.begin(), pairs.end());
      pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());

      LocalBlocks blocks;
      blocks.begin.assign(space.n_local + 1, 0);
      for (const std::uint64_t pair : pairs)
        {
          ++blocks.begin[(pair >> 32) + 1];
          blocks.columns.push_back(static_cast<unsigned int>(pair));
        }
      for (unsigned int node = 0; node < space.n_local; ++node)
        blocks.begin[node + 1] += blocks.begin[node];
      blocks.values.assign(pairs.size(), std::array<double, 9>{});

      std::map<const HexahedralElement *, std::vector<double>> matrices;
      for (unsigned int cell = 0; cell < n_cells; ++cell)
        {
          const HexahedralElement &element = level.stiffness.element(cell);
          std::vector<double>     &K       = matrices[&element];
          if (K.empty())
            for (unsigned int a = 0; a < 8; ++a)
              for (unsigned int b = 0; b < 8; ++b)
                for (unsigned int ij = 0; ij < 9; ++ij)
                  K.push_back(element.entry(a, ij / 3, b, ij % 3));
          cell_parts.reinit(space, cell);
          for (const auto &a : cell_parts.parts)
            for (const auto &b : cell_parts.parts)
              {
                const auto from = blocks.columns.begin() + blocks.begin[a.node];
                const auto to   = blocks.columns.begin() + blocks.begin[a.node + 1];
                auto      &block
                  = blocks.values[std::lower_bound(from, to, b.node) - blocks.columns.begin()];
                const double factor = level.stiffness.scale(cell) * a.weight * b.weight;
                for (unsigned int ij = 0; ij < 9; ++ij)
                  block[ij] += factor * K[9 * (8 * a.corner + b.corner) + ij];
              }
        }
      return blocks;
    }

    /** The matrix over all ranks, with the supports built in. Collective. */
    std::unique_ptr<Epetra_FECrsMatrix>
    make_matrix(const HexahedralLevel &level)
    {
      const LocalBlocks blocks = assemble(level);
      const auto       &layout = *level.space.layout;
      const auto       &fixed  = level.supports.fixed;
      const Epetra_Map  rows
        = layout.locally_owned_range().make_trilinos_map(layout.get_mpi_communicator(), false);
      std::vector<int> lengths(3 * level.space.n_owned);
      for (unsigned int i = 0; i < lengths.size(); ++i)
        lengths[i] = 3 * (blocks.begin[i / 3 + 1] - blocks.begin[i / 3]);
      auto matrix = std::make_unique<Epetra_FECrsMatrix>(Copy, rows, lengths.data());

      std::vector<GlobalIndex> columns;
      std::vector<double>      values;
      for (unsigned int node = 0; node < level.space.n_local; ++node)
        for (unsigned int i = 0; i < 3; ++i)
          {
            columns.clear();
            values.clear();
            const bool row_fixed = (fixed[node] >> i & 1) != 0;
            for (std::size_t k = blocks.begin[node]; k < blocks.begin[node + 1]; ++k)
              for (unsigned int j = 0; j < 3; ++j)
                {
                  const unsigned int other    = blocks.columns[k];
                  const bool         diagonal = other == node && i == j;
                  if (!diagonal && (row_fixed || (fixed[other] >> j & 1) != 0))
                    continue;
                  columns.push_back(layout.local_to_global(3 * other + j));
                  values.push_back(blocks.values[k][3 * i + j]);
                }
            const GlobalIndex row = layout.local_to_global(3 * node + i);
            matrix->InsertGlobalValues(
              1, &row, static_cast<int>(columns.size()), columns.data(), values.data());
          }
      matrix->GlobalAssemble();
      matrix->OptimizeStorage();
      return matrix;
    }

    std::unique_ptr<MultiVector>
    rigid_motions(const HexahedralLevel &level, const Epetra_Map &rows)
    {
      const auto    &planes = level.forest.grid().planes;
      const Point<3> lower(planes[0].front(), planes[1].front(), planes[2].front());
      const Point<3> upper(planes[0].back(), planes[1].back(), planes[2].back());
      const Point<3> centre = lower + .5 * (upper - lower);
      auto           modes  = std::make_unique<MultiVector>(rows, 6);
      for (unsigned int node = 0; node < level.space.n_owned; ++node)
        {
          Point<3> x;
          for (unsigned int d = 0; d < 3; ++d)
            x[d] = level.positions.local_element(3 * node + d);
          for (unsigned int k = 0; k < 6; ++k)
            {
              const auto motion
                = mechanics::rigid_motion(k, x, centre, .5 * (upper - lower).norm());
              for (unsigned int c = 0; c < 3; ++c)
                (*modes)[k][3 * node + c]
                  = (level.supports.fixed[node] >> c & 1) != 0 ? 0. : motion[c];
            }
        }
      return modes;
    }

    class Amg : public Preconditioner
    {
    public:
      explicit Amg(const HexahedralLevel &level)
        : matrix(make_matrix(level)), modes(rigid_motions(level, matrix->RowMap()))
      {
        Teuchos::ParameterList parameters;
        ML_Epetra::SetDefaults("SA", parameters);
        parameters.set("ML output", 0);
        parameters.set("PDE equations", 3);
        parameters.set("smoother: type", "Chebyshev");
        parameters.set("smoother: sweeps", 2);
        parameters.set("smoother: Chebyshev alpha", 20.);
        parameters.set("coarse: max size", 1000);
        parameters.set("coarse: type", "Amesos-KLU");
        parameters.set("coarse: add to diag", 1e-14 * matrix->NormInf());
        parameters.set("ML validate parameter list", false);
        parameters.set("aggregation: type", "Uncoupled");
        parameters.set("null space: type", "pre-computed");
        parameters.set("null space: dimension", modes->NumVectors());
        parameters.set("null space: vectors", modes->Values());
        amg.initialize(*matrix, parameters);
      }

      void
      vmult(Vector &destination, const Vector &source) const override
      {
        amg.vmult(destination, source);
      }

    private:
      std::unique_ptr<Epetra_FECrsMatrix> matrix;
      std::unique_ptr<MultiVector>        modes; ///< ML keeps a pointer to it
      AmgPreconditioner                   amg;
    };
  } // namespace

  std::unique_ptr<Preconditioner>
  make_amg(const HexahedralLevel &level)
  {
    return std::make_unique<Amg>(level);
  }
} // namespace tetradapt::solve
