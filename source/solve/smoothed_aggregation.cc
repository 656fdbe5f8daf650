// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/rigid_motions.h"
#include "tetradapt/solve/chebyshev.h"
#include "tetradapt/solve/preconditioners.h"

#include "coarsening.h"
#include "dense_cholesky.h"

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
      explicit Prolongation(const BlockRows<n, 6> &rows)
        : begin(rows.begin), columns(rows.columns), blocks(rows.blocks.size())
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
      Level(const BlockRows<n, n> &rows, const Layout &layout, double scale = 1.)
        : matrix(rows, layout, scale),
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

    /**
     * Levels are distributed like their matrices while they have enough nodes a rank, and on
     * every rank from there on.
     * Those below the finest are in double precision always: where a stiff part hangs on a
     * soft one, rounding its coarse matrix would outweigh what holds it. The finest level
     * may be rounded: the cycle is positive as long as the levels below are.
     */
    template <typename Number>
    class SmoothedAggregation : public ApproximateInverse<Number>
    {
    public:
      SmoothedAggregation(const BlockRows<3, 3>           &rows,
                          const std::vector<NodeModes<3>> &modes,
                          const Layout                    &layout,
                          double                           scale)
        : fine(rows, layout, scale)
      {
        auto coarsening = coarsen(
          rows, modes, layout, fine_threshold, damping / fine.smoother.largest_eigenvalue(), 0.);
        if (!coarsening)
          return;
        fine.prolongation = Prolongation<Number, 3>(coarsening->prolongation);
        for (auto &block : coarsening->coarse.rows.blocks)
          for (double &entry : block)
            entry *= scale;
        build_coarse(std::move(coarsening->coarse));
      }

      void
      vmult(VectorOf<Number> &destination, const VectorOf<Number> &source) const override
      {
        cycle(fine, 0, destination, source);
      }

    private:
      void
      build_coarse(CoarseMatrix matrix)
      {
        while (matrix.n_nodes > max_coarse_rows)
          {
            coarse.push_back(std::make_unique<Level<double, 6>>(matrix.rows, matrix.layout));
            Level<double, 6> &level      = *coarse.back();
            auto              coarsening = coarsen(matrix.rows,
                                      matrix.modes,
                                      matrix.layout,
                                      coarse_threshold,
                                      damping / level.smoother.largest_eigenvalue(),
                                      2.);
            if (!coarsening)
              return; // nothing gained by going on: the smoother has to do
            level.prolongation = Prolongation<double, 6>(coarsening->prolongation);
            matrix             = std::move(coarsening->coarse);
          }
        bottom = std::make_unique<DenseCholesky>(matrix.rows);
        bottom_values.reinit(matrix.layout);
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
            add_up(forces, *level.matrix.vector_layout());
            const VectorOf<double> &correction = solve_below(next);
            correction.update_ghost_values();
            level.prolongation.add(x.begin(), correction.begin());
            correction.zero_out_ghost_values();
          }
        level.smoother.step(x, b);
      }

      /** Sums forces to which the ranks of the finer level @p from have added their parts. */
      void
      add_up(VectorOf<double> &forces, const dealii::Utilities::MPI::Partitioner &from) const
      {
        if (forces.get_partitioner()->n_mpi_processes() > 1)
          forces.compress(dealii::VectorOperation::add);
        else if (from.n_mpi_processes() > 1)
          MPI_Allreduce(MPI_IN_PLACE,
                        forces.begin(),
                        static_cast<int>(forces.size()),
                        MPI_DOUBLE,
                        MPI_SUM,
                        from.get_mpi_communicator());
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

      Level<Number, 3>                               fine;
      std::vector<std::unique_ptr<Level<double, 6>>> coarse;
      std::unique_ptr<DenseCholesky>                 bottom;
      mutable VectorOf<double>                       bottom_values;
    };

    std::vector<NodeModes<3>>
    rigid_modes(const fem::Space &space, const fem::FixedUnknowns &fixed)
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
                modes[node][6 * c + k] = fixed.is_fixed(node, c) ? 0. : motion[c];
            }
        }
      return modes;
    }
  } // namespace

  template <typename Number>
  std::unique_ptr<ApproximateInverse<Number>>
  make_amg(const mechanics::BlockMatrix &matrix,
           const fem::Space             &space,
           const fem::FixedUnknowns     &fixed,
           const double                  scale)
  {
    return std::make_unique<SmoothedAggregation<Number>>(matrix.rows(),
                                                         rigid_modes(space, fixed),
                                                         space.vector_layout(),
                                                         scale);
  }

  std::unique_ptr<Preconditioner>
  make_amg(const BlockRows<3, 3>                                            &rows,
           const std::vector<NodeModes<3>>                                  &modes,
           const std::shared_ptr<const dealii::Utilities::MPI::Partitioner> &layout)
  {
    return std::make_unique<SmoothedAggregation<double>>(rows, modes, layout, 1.);
  }

  template std::unique_ptr<ApproximateInverse<float>>
  make_amg(const mechanics::BlockMatrix &, const fem::Space &, const fem::FixedUnknowns &, double);
  template std::unique_ptr<ApproximateInverse<double>>
  make_amg(const mechanics::BlockMatrix &, const fem::Space &, const fem::FixedUnknowns &, double);
} // namespace tetradapt::solve
