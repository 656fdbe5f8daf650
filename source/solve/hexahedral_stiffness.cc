// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/hexahedral_stiffness.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace tetradapt::solve
{
  namespace
  {
    /** Cells cut from bricks of one shape and material have the same stiffness, but for a
     * factor. */
    struct BrickKind
    {
      int                        region;
      Tensor<1, 3>               size;
      dealii::FullMatrix<double> matrix;
    };
  } // namespace

  HexahedralStiffness::HexahedralStiffness(const HexahedralSpace        &space,
                                           const Constraints            &constraints,
                                           const mechanics::MaterialMap &materials,
                                           const MatrixFree             &matrix_free,
                                           const unsigned int            index)
    : space(space), constraints(constraints), matrix_free(matrix_free), index(index)
  {
    for (unsigned int batch = 0; batch < matrix_free.n_cell_batches(); ++batch)
      {
        const int region
          = static_cast<int>(matrix_free.get_cell_iterator(batch, 0, index)->material_id());
        region_of_batch.push_back(region);
        tangents[region] = materials.linear_law(region).tangent_at_rest();
      }
  }

  void
  HexahedralStiffness::multiply(Cells &cells) const
  {
    const auto &tangent = tangents.at(region_of_batch[cells.get_current_cell_index()]);
    cells.evaluate(dealii::EvaluationFlags::gradients);
    for (unsigned int q = 0; q < cells.n_q_points; ++q)
      cells.submit_symmetric_gradient(tangent * cells.get_symmetric_gradient(q), q);
    cells.integrate(dealii::EvaluationFlags::gradients);
  }

  void
  HexahedralStiffness::vmult(Vector &forces, const Vector &displacement) const
  {
    matrix_free.cell_loop<Vector, Vector>(
      [this](const auto &, Vector &to, const Vector &from, const auto &range) {
        Cells cells(matrix_free, index, index);
        for (unsigned int batch = range.first; batch < range.second; ++batch)
          {
            cells.reinit(batch);
            cells.read_dof_values(from);
            multiply(cells);
            cells.distribute_local_to_global(to);
          }
      },
      forces,
      displacement,
      true);
  }

  HexahedralStiffness::InnerForces
  HexahedralStiffness::inner_forces(const Vector &displacement) const
  {
    InnerForces result;
    double      sums[2] = {0., 0.}; // of products with the displacement, and of squares
    result.on_free.reinit(vector_layout());
    matrix_free.cell_loop<Vector, Vector>(
      [&](const auto &, Vector &to, const Vector &from, const auto &range) {
        Cells                         cells(matrix_free, index, index);
        dealii::AlignedVector<Number> values(cells.dofs_per_cell);
        for (unsigned int batch = range.first; batch < range.second; ++batch)
          {
            cells.reinit(batch);
            cells.read_dof_values_plain(from);
            std::copy_n(cells.begin_dof_values(), values.size(), values.begin());
            multiply(cells);
            for (unsigned int i = 0; i < values.size(); ++i)
              for (unsigned int v = 0; v < matrix_free.n_active_entries_per_cell_batch(batch); ++v)
                {
                  const double force = cells.begin_dof_values()[i][v];
                  sums[0] += values[i][v] * force;
                  sums[1] += force * force;
                }
            cells.distribute_local_to_global(to);
          }
      },
      result.on_free,
      displacement,
      true);
    const auto ranks = space.forest().communicator();
    result.energy    = dealii::Utilities::MPI::sum(sums[0], ranks);
    result.size      = std::sqrt(dealii::Utilities::MPI::sum(sums[1], ranks));
    return result;
  }

  dealii::FullMatrix<double>
  HexahedralStiffness::cell_matrix(const unsigned int batch, const unsigned int lane) const
  {
    Cells cells(matrix_free, index, index);
    cells.reinit(batch);
    const unsigned int         size = cells.dofs_per_cell;
    dealii::FullMatrix<double> matrix(size, size);
    const auto &place = matrix_free.get_shape_info(index, index).lexicographic_numbering;
    for (unsigned int j = 0; j < size; ++j)
      {
        std::fill_n(cells.begin_dof_values(), size, Number(0.));
        cells.begin_dof_values()[j] = 1.;
        multiply(cells);
        for (unsigned int i = 0; i < size; ++i)
          matrix(place[i], place[j]) = cells.begin_dof_values()[i][lane];
      }
    return matrix;
  }

  template <typename Function>
  void
  HexahedralStiffness::for_cell_matrices(const Function &function) const
  {
    std::vector<BrickKind> kinds;
    HexahedralSpace::Dofs  dofs(3 * space.nodes_per_cell());
    for (unsigned int batch = 0; batch < matrix_free.n_cell_batches(); ++batch)
      for (unsigned int lane = 0; lane < matrix_free.n_active_entries_per_cell_batch(batch); ++lane)
        {
          const auto cell = matrix_free.get_cell_iterator(batch, lane, index);
          // Halving a cell multiplies the derivatives' squares by four and divides the
          // volume by eight.
          const double       scale = std::ldexp(1., cell->level());
          const Tensor<1, 3> size  = scale * (cell->vertex(7) - cell->vertex(0));
          auto               kind  = std::find_if(kinds.begin(), kinds.end(), [&](const auto &k) {
            return k.region == region_of_batch[batch]
                   && (k.size - size).norm() < 1e-12 * size.norm();
          });
          if (kind == kinds.end())
            {
              kinds.push_back({region_of_batch[batch], size, cell_matrix(batch, lane)});
              kind = kinds.end() - 1;
              kind->matrix *= scale;
            }
          cell->get_dof_indices(dofs);
          function(dofs, kind->matrix, 1. / scale);
        }
  }

  Vector
  HexahedralStiffness::diagonal() const
  {
    Vector result(vector_layout());
    for_cell_matrices([&](const auto &dofs, const auto &matrix, const double factor) {
      for (unsigned int i = 0; i < dofs.size(); ++i)
        if (const auto *parents = constraints.get_constraint_entries(dofs[i]))
          {
            for (const auto &[parent, weight] : *parents)
              result(parent) += weight * weight * factor * matrix(i, i);
          }
        else
          result(dofs[i]) += factor * matrix(i, i);
    });
    result.compress(dealii::VectorOperation::add);
    for (const unsigned int i : matrix_free.get_constrained_dofs(index))
      result.local_element(i) = 1.;
    return result;
  }

  void
  HexahedralStiffness::assemble(SparseMatrix &matrix) const
  {
    dealii::FullMatrix<double> scaled;
    for_cell_matrices([&](const auto &dofs, const auto &of_brick, const double factor) {
      scaled = of_brick;
      scaled *= factor;
      constraints.distribute_local_to_global(scaled, dofs, matrix);
    });
    matrix.compress(dealii::VectorOperation::add);
  }
} // namespace tetradapt::solve
