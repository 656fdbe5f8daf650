// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/hexahedral_system.h"

#include "messages.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/solve/conjugate_gradients.h"
#include "tetradapt/solve/energies.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace tetradapt::solve
{
  namespace
  {
    constexpr double default_error = 1e-6;  ///< of iterations, by the solution
    constexpr double rounding      = 1e-13; ///< of a residual, by the forces

    /** The whole field, on every rank. Collective. */
    std::shared_ptr<mesh::HexahedralField>
    gather_field(const HexahedralSpace &space, const Vector &displacement)
    {
      const HexahedralForest &forest = space.forest();
      std::vector<double>     numbers, nodal;
      HexahedralSpace::Dofs   dofs;
      numbers.reserve(7 * forest.cells().size());
      nodal.reserve(3 * forest.cells().size() * space.nodes_per_cell());
      displacement.update_ghost_values();
      for (unsigned int c = 0; c < forest.cells().size(); ++c)
        {
          const HexahedralCell &cell = forest.cells()[c];
          for (unsigned int d = 0; d < 3; ++d)
            numbers.insert(numbers.end(), {cell.lower[d], cell.size[d]});
          numbers.push_back(cell.region);
          space.get_dofs(c, dofs);
          for (const auto dof : dofs)
            nodal.push_back(displacement(dof));
        }
      displacement.zero_out_ghost_values();
      numbers = all_gather_values(numbers, forest.communicator());
      nodal   = all_gather_values(nodal, forest.communicator());

      std::vector<mesh::HexahedralField::Cell> cells(numbers.size() / 7);
      std::vector<Tensor<1, 3>>                values(nodal.size() / 3);
      for (std::size_t c = 0; c < cells.size(); ++c)
        {
          for (unsigned int d = 0; d < 3; ++d)
            {
              cells[c].lower[d] = numbers[7 * c + 2 * d];
              cells[c].size[d]  = numbers[7 * c + 2 * d + 1];
            }
          cells[c].region = static_cast<int>(numbers[7 * c + 6]);
        }
      for (std::size_t i = 0; i < nodal.size(); ++i)
        values[i / 3][i % 3] = nodal[i];
      return std::make_shared<mesh::HexahedralField>(space.degree(),
                                                     forest.grid().planes,
                                                     std::move(cells),
                                                     std::move(values));
    }

    /** The first iterate: the field of the mesh before, and what is prescribed. Collective. */
    Vector
    first_iterate(const HexahedralLevel &level, const mesh::HexahedralField *before)
    {
      const HexahedralSpace  &space  = level.space;
      const HexahedralForest &forest = space.forest();
      Vector                  x(level.stiffness->vector_layout());
      const auto              along = mesh::hexahedral_nodes(space.degree());
      const unsigned int      n     = along.size();
      std::vector<bool>       known(x.locally_owned_size(), false);
      HexahedralSpace::Dofs   dofs;
      for (unsigned int c = 0; before != nullptr && c < forest.cells().size(); ++c)
        {
          space.get_dofs(c, dofs);
          for (unsigned int i = 0; i < space.nodes_per_cell(); ++i)
            if (x.in_local_range(dofs[3 * i])
                && !known[x.get_partitioner()->global_to_local(dofs[3 * i])])
              {
                known[x.get_partitioner()->global_to_local(dofs[3 * i])] = true;
                const auto at                                            = before->locate(
                  forest.cells()[c].at({along[i % n], along[i / n % n], along[i / n / n]}));
                const Tensor<1, 3> u = before->value(at.cell, at.unit);
                for (unsigned int d = 0; d < 3; ++d)
                  x(dofs[3 * i + d]) = u[d];
              }
        }
      level.constraints.distribute(x);
      return x;
    }

    /** Conjugate gradients for what is missing to @p x, until the estimated error in the
     * energy norm is below @p error, or, if that is zero, below default_error of what the
     * iteration has found, or of @p x if that is a solution on another mesh. */
    unsigned int
    iterate(const HexahedralLevel &level,
            const Preconditioner  &preconditioner,
            const Vector          &forces,
            const double           error,
            const bool             has_start,
            const unsigned int     max_iterations,
            const core::Log       &log,
            Vector                &x)
    {
      auto            inner    = level.stiffness->inner_forces(x);
      Vector         &residual = inner.on_free;
      Vector          correction(level.stiffness->vector_layout());
      IterationLimits limits;
      limits.residual = rounding * std::max(forces.l2_norm(), inner.size);
      if (!std::isfinite(forces.l2_norm() + inner.size)) // a maximum may hide NaN
        throw core::NumericalError("The forces on the reference's hexahedra, or their squares, are "
                                   "not finite. Look at the loads, the supports and the material "
                                   "constants, or choose other units.");
      limits.error
        = error > 0. || !has_start ? error : default_error * std::sqrt(std::max(0., inner.energy));
      limits.relative_error = limits.error > 0. ? 0. : default_error;
      limits.max_iterations = max_iterations;
      residual.sadd(-1., 1., forces);
      level.constraints.set_zero(residual);
      EnergyControl control(limits, [&](const unsigned int step, double) {
        log.progress("conjugate gradients, iteration " + std::to_string(step));
      });
      if (conjugate_gradients(*level.stiffness, preconditioner, residual, control, correction)
          != Ending::converged)
        throw core::NumericalError(
          "Conjugate gradients did not converge on the reference's hexahedra in "
          + std::to_string(control.result().iterations)
          + " iterations. Look for materials of very different stiffness or a Poisson ratio "
            "close to 0.5; or raise Solver/Maximum iterations.");
      x += correction;
      level.constraints.distribute(x);
      return control.result().iterations;
    }

    /** See HexahedralSolution::gain_sign. Collective. */
    int
    sign_of_gain(const HexahedralLevel &level, const Vector &forces)
    {
      const bool moved
        = dealii::Utilities::MPI::max(level.constraints.has_inhomogeneities() ? 1 : 0,
                                      level.space.forest().communicator())
          > 0,
        loaded = forces.linfty_norm() > 0.;
      return moved == loaded ? 0 : loaded ? 1 : -1;
    }
  } // namespace

  HexahedralSystem::HexahedralSystem(const scene::Scene           &scene,
                                     const mechanics::MaterialMap &materials,
                                     const HexahedralForest       &forest,
                                     const unsigned int            degree)
    : scene(scene), materials(materials), levels(scene, materials, forest, degree)
  {
  }

  HexahedralSolution
  HexahedralSystem::solve(const mesh::TetMesh         &mesh,
                          const mesh::HexahedralField *start,
                          const double                 algebraic_error,
                          const core::Log             &log) const
  {
    const HexahedralLevel &fine = levels.fine;
    Vector                 forces(fine.stiffness->vector_layout());
    nodal_forces(scene, mesh, materials, fine.space, forces);
    HexahedralSolution solution;
    solution.nodal            = first_iterate(fine, start);
    const auto preconditioner = make_hexahedral_multigrid(levels);
    solution.iterations       = iterate(fine,
                                  *preconditioner,
                                  forces,
                                  algebraic_error,
                                  start != nullptr,
                                  scene.solver.max_iterations,
                                  log,
                                  solution.nodal);
    solution.energy           = std::max(0., fine.stiffness->inner_forces(solution.nodal).energy);
    solution.gain             = 2. * (forces * solution.nodal) - solution.energy;
    solution.displacement     = gather_field(fine.space, solution.nodal);
    // Strain that temperatures cause freely is no stress.
    solution.norm      = std::sqrt(materials.has_thermal_strain()
                                ? 2.
                                    * compute_energies(*solution.displacement,
                                                       materials,
                                                       fine.space.forest().communicator())
                                        .stored
                                : solution.energy);
    solution.gain_sign = sign_of_gain(fine, forces);
    if (solution.gain_sign != 0)
      solution.energy = solution.gain_sign * solution.gain;
    return solution;
  }
} // namespace tetradapt::solve
