// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/rigid_motions.h"
#include "tetradapt/solve/chebyshev.h"
#include "tetradapt/solve/preconditioners.h"

#include "dense_cholesky.h"
#include "node_exchange.h"

#include <deal.II/base/array_view.h>
#include <deal.II/base/mpi.h>

#include <algorithm>

namespace tetradapt::solve
{
  namespace
  {
    constexpr unsigned int smoother_degree = 2;
    /** Of the prolongation, in units of the inverse of the largest eigenvalue. */
    constexpr double damping = 1.45;
    /** Couplings that aggregates follow, relative to the largest: supports of smoothed
     * prolongations overlap far and weakly on the coarser levels. */
    constexpr double       fine_threshold = 0.1, coarse_threshold = 0.25;
    constexpr unsigned int max_coarse_rows = 60; ///< aggregates that a dense matrix is made for

    template <typename Number, unsigned int n>
    class Prolongation
    {
    public:
      Prolongation() = default;
      Prolongation(const BlockRows<n, 6> &rows, unsigned int n_rows)
        : begin(rows.begin.begin(), rows.begin.begin() + n_rows + 1),
          columns(rows.columns.begin(), rows.columns.begin() + begin.back()), blocks(begin.back())
      {
        for (std::size_t k = 0; k < blocks.size(); ++k)
          std::copy(rows.blocks[k].begin(), rows.blocks[k].end(), blocks[k].begin());
      }

      /** fine += P coarse. */
      void
      add(Number *fine, const double *coarse) const
      {
        for (std::size_t row = 0; row + 1 < begin.size(); ++row, fine += n)
          for (std::size_t k = begin[row]; k < begin[row + 1]; ++k)
            {
              Number x[6];
              std::copy_n(coarse + 6 * std::size_t(columns[k]), 6, x);
              for (unsigned int i = 0; i < n; ++i)
                for (unsigned int j = 0; j < 6; ++j)
                  fine[i] += blocks[k][6 * i + j] * x[j];
            }
      }

      /** coarse += P^T fine. */
      void
      add_transposed(double *coarse, const Number *fine) const
      {
        for (std::size_t row = 0; row + 1 < begin.size(); ++row, fine += n)
          for (std::size_t k = begin[row]; k < begin[row + 1]; ++k)
            {
              Number sums[6] = {};
              for (unsigned int i = 0; i < n; ++i)
                for (unsigned int j = 0; j < 6; ++j)
                  sums[j] += blocks[k][6 * i + j] * fine[i];
              double *x = coarse + 6 * std::size_t(columns[k]);
              for (unsigned int j = 0; j < 6; ++j)
                x[j] += sums[j];
            }
      }

    private:
      std::vector<std::size_t>               begin{0};
      std::vector<unsigned int>              columns;
      std::vector<std::array<Number, 6 * n>> blocks;
    };

    /** A level with n unknowns a node. */
    template <typename Number, unsigned int n>
    struct Level
    {
      Level(const BlockRows<n, n> &rows, const Layout &layout)
        : matrix(rows, layout),
          smoother(matrix, invert_blocks<Number, n>(matrix.diagonal_blocks()), smoother_degree),
          residual(layout)
      {
        if (n == 6)
          for (auto *vector : {&solution, &correction, &right_hand_side})
            vector->reinit(layout);
      }

      BlockOperator<Number, n>     matrix;
      ChebyshevSmoother<Number, n> smoother;
      Prolongation<Number, n>      prolongation; ///< from the level below
      mutable VectorOf<Number>     residual;
      mutable VectorOf<Number>     solution, correction, right_hand_side; ///< not on the finest
    };

    template <unsigned int n>
    std::vector<std::array<double, n * n>>
    inverse_diagonal(const BlockRows<n, n> &matrix)
    {
      std::vector<std::array<double, n * n>> diagonal(matrix.n_rows());
      for (unsigned int row = 0; row < matrix.n_rows(); ++row)
        for (std::size_t k = matrix.begin[row]; k < matrix.begin[row + 1]; ++k)
          if (matrix.columns[k] == row)
            diagonal[row] = matrix.blocks[k];
      return invert_blocks<double, n>(diagonal);
    }

    /** Unknowns of motions that an aggregate does not have get a one on the diagonal. */
    void
    fill_empty_rows(BlockRows<6, 6> &matrix)
    {
      for (unsigned int row = 0; row < matrix.n_rows(); ++row)
        for (std::size_t k = matrix.begin[row]; k < matrix.begin[row + 1]; ++k)
          if (matrix.columns[k] == row)
            for (unsigned int i = 0; i < 6; ++i)
              if (!(matrix.blocks[k][7 * i] > 0.))
                matrix.blocks[k][7 * i] = 1.;
    }

    /**
     * The finest level is distributed like its matrix. From the next on, every rank holds
     * everything and does the same, since these levels hold a few per cent of the work.
     * They are in double precision always: where a stiff part hangs on a soft one, rounding
     * its coarse matrix would outweigh what holds it. The finest level may be rounded: the
     * cycle is positive as long as the levels below are.
     */
    template <typename Number>
    class SmoothedAggregation : public ApproximateInverse<Number>
    {
    public:
      SmoothedAggregation(const BlockRows<3, 3>           &rows,
                          const std::vector<NodeModes<3>> &modes,
                          const Layout                    &layout)
        : communicator(layout->get_mpi_communicator()), fine(rows, layout)
      {
        const Aggregates aggregates = aggregate(rows, fine_threshold);
        auto             tentative  = tentative_prolongation<3>(aggregates, modes);
        const auto   counts = dealii::Utilities::MPI::all_gather(communicator, aggregates.count);
        unsigned int first = 0, total = 0;
        for (unsigned int rank = 0; rank < counts.size(); ++rank)
          {
            first
              += rank < dealii::Utilities::MPI::this_mpi_process(communicator) ? counts[rank] : 0;
            total += counts[rank];
          }
        auto P            = smooth<3>(rows,
                           inverse_diagonal(rows),
                           with_ghosts(aggregates, tentative.rows, first, layout),
                           total,
                           damping / fine.smoother.largest_eigenvalue());
        fine.prolongation = Prolongation<Number, 3>(P, rows.n_rows());
        append_ghost_rows(P, layout);
        auto coarse = sum_over_ranks(galerkin(rows, P, total), communicator);
        build_coarse(std::move(coarse), gather_modes(tentative.coarse_modes, communicator));
      }

      void
      vmult(VectorOf<Number> &destination, const VectorOf<Number> &source) const override
      {
        cycle(fine, 0, destination, source);
      }

    private:
      void
      build_coarse(BlockRows<6, 6> matrix, std::vector<NodeModes<6>> modes)
      {
        fill_empty_rows(matrix);
        while (matrix.n_rows() > max_coarse_rows)
          {
            const unsigned int n_rows = matrix.n_rows();
            coarse.push_back(std::make_unique<Level<double, 6>>(
              matrix, std::make_shared<dealii::Utilities::MPI::Partitioner>(6 * n_rows)));
            Level<double, 6> &level      = *coarse.back();
            const Aggregates  aggregates = aggregate(matrix, coarse_threshold);
            if (aggregates.count == 0 || 2 * aggregates.count > n_rows)
              return; // nothing gained by going on: the smoother has to do
            const auto tentative = tentative_prolongation<6>(aggregates, modes);
            const auto P         = smooth<6>(matrix,
                                     inverse_diagonal(matrix),
                                     LocalTentative<6>{aggregates.of_node, tentative.rows},
                                     aggregates.count,
                                     damping / level.smoother.largest_eigenvalue());
            level.prolongation   = Prolongation<double, 6>(P, n_rows);
            matrix               = galerkin(matrix, P, aggregates.count);
            fill_empty_rows(matrix);
            modes = tentative.coarse_modes;
          }
        bottom = std::make_unique<DenseCholesky>(matrix);
        bottom_values.reinit(6 * matrix.n_rows());
      }

      /** x = about A^-1 b on a level; @p next is the one below in coarse. */
      template <typename LevelNumber, unsigned int n>
      void
      cycle(const Level<LevelNumber, n> &level,
            std::size_t                  next,
            VectorOf<LevelNumber>       &x,
            const VectorOf<LevelNumber> &b) const
      {
        level.smoother.start(x, b);
        if (next < coarse.size() || bottom != nullptr)
          {
            level.matrix.vmult(level.residual, x);
            level.residual.sadd(-1, 1, b);
            VectorOf<double> &forces
              = next < coarse.size() ? coarse[next]->right_hand_side : bottom_values;
            forces = 0.;
            level.prolongation.add_transposed(forces.begin(), level.residual.begin());
            if (n == 3)
              dealii::Utilities::MPI::sum(dealii::ArrayView<const double>(forces.begin(),
                                                                          forces.size()),
                                          communicator,
                                          dealii::ArrayView<double>(forces.begin(), forces.size()));
            level.prolongation.add(x.begin(), solve_below(next).begin());
          }
        level.smoother.step(x, b);
      }

      /** The correction for the right-hand side that is stored with level @p i of coarse.
       * Two cycles from the second on, where they cost little (a W-cycle). */
      const VectorOf<double> &
      solve_below(std::size_t i) const
      {
        if (i == coarse.size())
          {
            bottom->solve(bottom_values.begin());
            return bottom_values;
          }
        const Level<double, 6> &level = *coarse[i];
        cycle(level, i + 1, level.solution, level.right_hand_side);
        if (i == 0)
          return level.solution;
        level.matrix.vmult(level.residual, level.solution);
        level.right_hand_side -= level.residual;
        cycle(level, i + 1, level.correction, level.right_hand_side);
        level.solution += level.correction;
        return level.solution;
      }

      MPI_Comm                                       communicator;
      Level<Number, 3>                               fine;
      std::vector<std::unique_ptr<Level<double, 6>>> coarse;
      std::unique_ptr<DenseCholesky>                 bottom;
      mutable VectorOf<double>                       bottom_values;
    };

    BlockRows<3, 3>
    scaled_rows(const mechanics::BlockMatrix &matrix, double scale)
    {
      BlockRows<3, 3> rows;
      rows.columns.resize(matrix.n_blocks());
      rows.blocks.resize(matrix.n_blocks());
      for (std::size_t k = 0; k < matrix.n_blocks(); ++k)
        {
          rows.columns[k] = matrix.column(k);
          for (unsigned int i = 0; i < 9; ++i)
            rows.blocks[k][i] = scale * matrix.block(k)[i];
        }
      for (unsigned int row = 0; row < matrix.n_rows(); ++row)
        rows.begin.push_back(matrix.row_end(row));
      return rows;
    }

    std::vector<NodeModes<3>>
    rigid_modes(const mechanics::DisplacementSpace      &space,
                const mechanics::PrescribedDisplacement &prescribed)
    {
      const auto               &mesh   = space.tet_mesh();
      const auto                box    = mesh::bounding_box(mesh);
      const auto                centre = box.first + 0.5 * (box.second - box.first);
      const double              length = 0.5 * (box.second - box.first).norm();
      std::vector<NodeModes<3>> modes(space.n_owned_nodes());
      for (unsigned int node = 0; node < modes.size(); ++node)
        {
          const unsigned int field_node = space.field_node(node);
          for (unsigned int k = 0; k < 6; ++k)
            {
              const auto motion
                = mechanics::rigid_motion(k, mesh.points[field_node], centre, length);
              for (unsigned int c = 0; c < 3; ++c)
                modes[node][6 * c + k] = prescribed.is_fixed(field_node, c) ? 0. : motion[c];
            }
        }
      return modes;
    }
  } // namespace

  template <typename Number>
  std::unique_ptr<ApproximateInverse<Number>>
  make_amg(const mechanics::BlockMatrix            &matrix,
           const mechanics::DisplacementSpace      &space,
           const mechanics::PrescribedDisplacement &prescribed,
           const double                             scale)
  {
    return std::make_unique<SmoothedAggregation<Number>>(scaled_rows(matrix, scale),
                                                         rigid_modes(space, prescribed),
                                                         space.vector_layout());
  }

  template std::unique_ptr<ApproximateInverse<float>>
  make_amg(const mechanics::BlockMatrix &,
           const mechanics::DisplacementSpace &,
           const mechanics::PrescribedDisplacement &,
           double);
  template std::unique_ptr<ApproximateInverse<double>>
  make_amg(const mechanics::BlockMatrix &,
           const mechanics::DisplacementSpace &,
           const mechanics::PrescribedDisplacement &,
           double);
} // namespace tetradapt::solve
