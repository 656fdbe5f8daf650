// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/hexahedral_multigrid.h"

#include "tetradapt/mesh/hexahedral_field.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/fe/mapping_q1.h>
#include <deal.II/lac/diagonal_matrix.h>
#include <deal.II/lac/precondition.h>

namespace tetradapt::solve
{
  namespace
  {
    /**
     * Embedding of degree 1 in a higher degree on the same cells, and its transpose.
     *
     * deal.II's MGTwoLevelTransfer does the same, but up to 9.4 it numbers all cells that
     * bricks could be cut into down to the present depth, eight times as many with each level.
     */
    class Transfer
    {
    public:
      explicit Transfer(const HexahedralLevels &levels)
        : matrix_free(levels.matrix_free), weights(levels.fine.stiffness->vector_layout())
      {
        const HexahedralSpace &space = levels.fine.space;
        HexahedralSpace::Dofs  dofs;
        for (unsigned int cell = 0; cell < space.forest().cells().size(); ++cell)
          {
            space.get_dofs(cell, dofs);
            for (const auto dof : dofs)
              weights(dof) += 1.;
          }
        weights.compress(dealii::VectorOperation::add);
        for (double &weight : weights)
          weight = 1. / weight;
        levels.fine.constraints.set_zero(weights);
        weights.update_ghost_values();

        const auto         along = mesh::hexahedral_nodes(space.degree());
        const unsigned int n     = along.size();
        for (unsigned int node = 0; node < n * n * n; ++node)
          {
            const double x[3] = {along[node % n], along[node / n % n], along[node / n / n]};
            for (unsigned int v = 0; v < 8; ++v)
              {
                double shape = 1.;
                for (unsigned int d = 0; d < 3; ++d)
                  shape *= (v >> d & 1) != 0 ? x[d] : 1. - x[d];
                shapes.push_back(shape);
              }
          }
      }

      /** fine += P coarse. */
      void
      prolongate_and_add(Vector &fine, const Vector &coarse) const
      {
        matrix_free.cell_loop<Vector, Vector>(
          [this](const auto &, Vector &to, const Vector &from, const auto &range) {
            for_cells(range, [&](Cells &fine_cells, Cells &weight, Cells &coarse_cells) {
              coarse_cells.read_dof_values(from);
              for (unsigned int i = 0; i < fine_cells.dofs_per_cell; ++i)
                {
                  fine_cells.begin_dof_values()[i] = 0.;
                  const unsigned int c = i / n_nodes(), node = i % n_nodes();
                  for (unsigned int v = 0; v < 8; ++v)
                    fine_cells.begin_dof_values()[i]
                      += shapes[8 * node + v] * coarse_cells.begin_dof_values()[8 * c + v];
                  fine_cells.begin_dof_values()[i] *= weight.begin_dof_values()[i];
                }
              fine_cells.distribute_local_to_global(to);
            });
          },
          fine,
          coarse);
      }

      /** coarse = P^T fine. */
      void
      restrict_to(Vector &coarse, const Vector &fine) const
      {
        matrix_free.cell_loop<Vector, Vector>(
          [this](const auto &, Vector &to, const Vector &from, const auto &range) {
            for_cells(range, [&](Cells &fine_cells, Cells &weight, Cells &coarse_cells) {
              fine_cells.read_dof_values_plain(from);
              std::fill_n(coarse_cells.begin_dof_values(), 24, Number(0.));
              for (unsigned int i = 0; i < fine_cells.dofs_per_cell; ++i)
                {
                  const unsigned int c = i / n_nodes(), node = i % n_nodes();
                  const Number       force
                    = weight.begin_dof_values()[i] * fine_cells.begin_dof_values()[i];
                  for (unsigned int v = 0; v < 8; ++v)
                    coarse_cells.begin_dof_values()[8 * c + v] += shapes[8 * node + v] * force;
                }
              coarse_cells.distribute_local_to_global(to);
            });
          },
          coarse,
          fine,
          true);
      }

    private:
      using Cells  = dealii::FEEvaluation<3, -1, 0, 3>;
      using Number = dealii::VectorizedArray<double>;

      unsigned int
      n_nodes() const
      {
        return shapes.size() / 8;
      }
      /** Calls function(cells of the fine level, their weights, the same cells of the coarse
       * level) for batches of cells. */
      template <typename Range, typename Function>
      void
      for_cells(const Range &range, const Function &function) const
      {
        Cells fine_cells(matrix_free, 0, 0), weight(matrix_free, 0, 0),
          coarse_cells(matrix_free, 1, 1);
        for (unsigned int batch = range.first; batch < range.second; ++batch)
          {
            for (Cells *cells : {&fine_cells, &weight, &coarse_cells})
              cells->reinit(batch);
            weight.read_dof_values_plain(weights);
            function(fine_cells, weight, coarse_cells);
          }
      }

      const MatrixFree   &matrix_free;
      Vector              weights; ///< one by the number of a node's cells; zero if constrained
      std::vector<double> shapes;  ///< the eight linear functions at each node of a cell
    };

    class HexahedralMultigrid : public Preconditioner
    {
    public:
      explicit HexahedralMultigrid(const HexahedralLevels &levels)
        : stiffness(*levels.fine.stiffness), transfer(levels),
          coarse_solver(make_hexahedral_amg(levels.coarse)), residual(stiffness.vector_layout()),
          coarse_residual(levels.coarse.stiffness->vector_layout()),
          coarse_correction(coarse_residual)
      {
        Smoother::AdditionalData data;
        data.preconditioner
          = std::make_shared<dealii::DiagonalMatrix<Vector>>(stiffness.diagonal());
        for (double &entry : data.preconditioner->get_vector())
          entry = 1. / entry;
        data.constraints.copy_from(levels.fine.constraints);
        data.eig_cg_n_iterations = 12;
        data.degree              = 2;
        data.smoothing_range     = 2. * levels.fine.space.degree();
        smoother.initialize(stiffness, data);
      }

      void
      vmult(Vector &destination, const Vector &source) const override
      {
        smoother.vmult(destination, source);
        stiffness.vmult(residual, destination);
        residual.sadd(-1., 1., source);
        transfer.restrict_to(coarse_residual, residual);
        coarse_solver->vmult(coarse_correction, coarse_residual);
        transfer.prolongate_and_add(destination, coarse_correction);
        smoother.step(destination, source);
      }

    private:
      using Smoother = dealii::PreconditionChebyshev<HexahedralStiffness, Vector>;

      const HexahedralStiffness      &stiffness;
      Transfer                        transfer;
      std::unique_ptr<Preconditioner> coarse_solver;
      Smoother                        smoother;
      mutable Vector                  residual, coarse_residual, coarse_correction;
    };
  } // namespace

  HexahedralLevels::HexahedralLevels(const scene::Scene           &scene,
                                     const mechanics::MaterialMap &materials,
                                     const HexahedralForest       &forest,
                                     const unsigned int            degree)
    : fine{{forest, degree}, Constraints(), nullptr}, coarse{{forest, 1}, Constraints(), nullptr}
  {
    for (HexahedralLevel *level : {&fine, &coarse})
      level->constraints = make_constraints(scene.supports, level->space);
    MatrixFree::AdditionalData data;
    data.tasks_parallel_scheme = MatrixFree::AdditionalData::none;
    data.mapping_update_flags  = dealii::update_gradients | dealii::update_JxW_values;
    data.cell_vectorization_categories_strict = true;
    for (const auto &cell : forest.triangulation().active_cell_iterators())
      data.cell_vectorization_category.push_back(cell->material_id());
    using Handlers       = std::vector<const dealii::DoFHandler<3> *>;
    using AllConstraints = std::vector<const Constraints *>;
    using Rules          = std::vector<dealii::QGauss<1>>;
    matrix_free.reinit(dealii::MappingQ1<3>(),
                       Handlers{&fine.space.dof_handler(), &coarse.space.dof_handler()},
                       AllConstraints{&fine.constraints, &coarse.constraints},
                       Rules{dealii::QGauss<1>(degree + 1), dealii::QGauss<1>(2)},
                       data);
    for (HexahedralLevel *level : {&fine, &coarse})
      level->stiffness = std::make_unique<HexahedralStiffness>(
        level->space, level->constraints, materials, matrix_free, level == &fine ? 0 : 1);
  }

  std::unique_ptr<Preconditioner>
  make_hexahedral_multigrid(const HexahedralLevels &levels)
  {
    return std::make_unique<HexahedralMultigrid>(levels);
  }
} // namespace tetradapt::solve
