// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/hexahedral_solution.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/solve/conjugate_gradients.h"
#include "tetradapt/solve/energies.h"
#include "tetradapt/solve/hexahedral_indicators.h"
#include "tetradapt/solve/hexahedral_multigrid.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <sstream>

namespace tetradapt::solve
{
  namespace
  {
    constexpr unsigned int first_cells   = 40;    ///< of the first mesh, at least
    constexpr double       growth        = 2.;    ///< of the cells from mesh to mesh
    constexpr double       closure       = 1.4;   ///< cells cut for each one marked
    constexpr double       algebraic     = 0.03;  ///< error of the solver by that of the mesh
    constexpr double       first_residue = 1e-6;  ///< the same by the solution, at first
    constexpr double       slowest_rate  = 0.25;  ///< s of errors N^-s, at strong singularities
    constexpr double       usual_rate    = 0.65;  ///< at edges
    constexpr double       rounding      = 1e-13; ///< of a residual, by the forces

    /** All ranks' lists, one after the other. Collective. */
    std::vector<double>
    gather(const std::vector<double> &own, MPI_Comm communicator)
    {
      if (dealii::Utilities::MPI::n_mpi_processes(communicator) == 1)
        return own;
      std::vector<double> all;
      for (const auto &part : dealii::Utilities::MPI::all_gather(communicator, own))
        all.insert(all.end(), part.begin(), part.end());
      return all;
    }

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
      numbers = gather(numbers, forest.communicator());
      nodal   = gather(nodal, forest.communicator());

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
     * energy norm is below @p error, or, if that is zero, below first_residue of what the
     * iteration has found. */
    unsigned int
    iterate(const HexahedralLevel &level,
            const Preconditioner  &preconditioner,
            const Vector          &forces,
            const double           error,
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
      limits.error          = error;
      limits.relative_error = error > 0. ? 0. : first_residue;
      limits.max_iterations = max_iterations;
      residual.sadd(-1., 1., forces);
      level.constraints.set_zero(residual);
      EnergyControl control(limits, [&](const unsigned int step, double) {
        log.progress("reference: conjugate gradients, iteration " + std::to_string(step));
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

    /** By what factor the number of cells is to grow: less where the tolerance is near. */
    double
    wanted_growth(const std::optional<double> &error, const double target)
    {
      if (!error || !(target > 0.))
        return growth;
      return std::min(growth, std::max(1.3, std::pow(1.1 * *error / target, 1. / usual_rate)));
    }

    /** Marks the own cells among those with the largest indicators. Collective. */
    std::vector<bool>
    mark(const std::vector<double> &indicators, const double factor, MPI_Comm communicator)
    {
      std::vector<double> all = gather(indicators, communicator);
      const std::size_t   n   = std::min<std::size_t>(
        all.size() - 1, static_cast<std::size_t>((factor - 1.) / (7. * closure) * all.size()));
      std::nth_element(all.begin(), all.begin() + n, all.end(), std::greater<>());
      // Equal ones are cut together, so that symmetry is kept.
      const double      least = .999 * all[n];
      std::vector<bool> flags(indicators.size());
      for (std::size_t c = 0; c < flags.size(); ++c)
        flags[c] = indicators[c] >= least;
      return flags;
    }

    /** Root of the sum of squares over all ranks. Collective. */
    double
    total(const std::vector<double> &indicators, MPI_Comm communicator)
    {
      const double own
        = std::inner_product(indicators.begin(), indicators.end(), indicators.begin(), 0.);
      return std::sqrt(dealii::Utilities::MPI::sum(own, communicator));
    }

    /** 1 if the energy a(u,u) is the gain: only loads act; -1 if it is that with the
     * other sign: only displacements are prescribed; else 0. Collective. */
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

    void
    report(const HexahedralSolution    &solution,
           const unsigned long          n_cells,
           const unsigned int           iterations,
           const std::optional<double> &error,
           const core::Log             &log)
    {
      std::ostringstream text;
      text << "Reference on hexahedra: " << n_cells << " cells, " << solution.n_dofs
           << " unknowns, " << iterations << " iterations, energy ";
      text.precision(10);
      text << solution.energy;
      text.precision(3);
      if (error)
        text << ", estimated relative error " << *error / solution.norm;
      log.detail(text.str());
    }
  } // namespace

  std::optional<double>
  calibrated_error(const std::vector<NestedSolution> &levels)
  {
    const std::size_t n = levels.size();
    if (n < 3)
      return std::nullopt;
    const NestedSolution &last   = levels.back();
    double                factor = 0., largest = 0.; // of squares
    for (std::size_t steps = 1; steps <= std::min<std::size_t>(5, n - 1); ++steps)
      {
        const NestedSolution &before = levels[n - 1 - steps];
        const double          gained = last.gain - before.gain;
        const double          decrease
          = before.indicator * before.indicator - last.indicator * last.indicator;
        if (decrease > 0.)
          factor = std::max(factor, gained / decrease);
        largest = std::max(
          largest, gained / std::expm1(2. * slowest_rate * std::log(last.n_dofs / before.n_dofs)));
      }
    if (!(largest > 0.))
      return std::nullopt;
    const double limit = std::sqrt(largest);
    return factor > 0. ? std::min(std::sqrt(factor) * last.indicator, limit) : limit;
  }

  HexahedralSolution
  solve_on_hexahedra(const scene::Scene           &scene,
                     const mechanics::MaterialMap &materials,
                     const mesh::TetMesh          &mesh,
                     const double                  tolerance,
                     MPI_Comm                      communicator,
                     const core::Log              &log)
  {
    const HexahedralGrid grid = make_hexahedral_grid(scene, mesh, log);
    HexahedralForest     forest(grid, communicator);
    while (forest.n_cells() < first_cells)
      forest.refine(std::vector<bool>(forest.cells().size(), true));

    HexahedralSolution solution;
    double             predicted = 0.; // error of the next mesh
    while (true)
      {
        const HexahedralLevels levels(scene, materials, forest, scene.reference.degree);
        const HexahedralLevel &fine = levels.fine;
        solution.n_dofs             = fine.space.n_dofs();
        if (solution.levels.empty() && solution.n_dofs > scene.reference.max_dofs)
          throw core::InputError(
            "Reference/Maximum unknowns: the coarsest hexahedra of this body have "
            + std::to_string(solution.n_dofs) + " unknowns. Allow more, or use Type = fine mesh.");
        log.progress("reference: " + std::to_string(solution.n_dofs) + " unknowns on hexahedra");
        Vector forces(fine.stiffness->vector_layout());
        nodal_forces(scene, mesh, materials, fine.space, forces);
        Vector       x              = first_iterate(fine, solution.displacement.get());
        const auto   preconditioner = make_hexahedral_multigrid(levels);
        const double limit
          = predicted > 0. ? algebraic * predicted : first_residue * std::sqrt(solution.energy);
        const unsigned int iterations
          = iterate(fine, *preconditioner, forces, limit, scene.solver.max_iterations, log, x);

        const double work     = forces * x;
        solution.energy       = std::max(0., fine.stiffness->inner_forces(x).energy);
        solution.displacement = gather_field(fine.space, x);
        const auto indicators = hexahedral_indicators(fine.space, materials, x);
        solution.levels.push_back(
          {double(solution.n_dofs), 2. * work - solution.energy, total(indicators, communicator)});
        // Strain that temperatures cause freely is no stress.
        solution.norm = std::sqrt(
          materials.has_thermal_strain()
            ? 2. * compute_energies(*solution.displacement, materials, communicator).stored
            : solution.energy);
        const double target = tolerance * solution.norm;
        auto         error  = calibrated_error(solution.levels);
        if (const int sign = sign_of_gain(fine, forces))
          {
            // What conjugate gradients left changes the gain in second order only.
            solution.energy              = sign * solution.levels.back().gain;
            solution.extrapolated_energy = solution.energy + sign * std::pow(error.value_or(0.), 2);
          }
        if (error)
          error = *error * (scene.reference.degree == 2 ? 1.5 : 1.3);
        // Where functions of this degree are the solution, refinement gains nothing.
        else if (solution.levels.back().indicator < .01 * target)
          error = solution.levels.back().indicator;
        report(solution, forest.n_cells(), iterations, error, log);
        // Too few levels to calibrate by: the indicator, with room.
        solution.estimated_error
          = error.value_or(std::min(solution.norm, 3. * solution.levels.back().indicator));
        solution.reached  = solution.estimated_error <= target;
        const double next = wanted_growth(error, target);
        if (solution.reached || next * solution.n_dofs > scene.reference.max_dofs)
          return solution;
        predicted = error.value_or(0.) * std::pow(next, -usual_rate);
        forest.refine(mark(indicators, next, communicator));
      }
  }
} // namespace tetradapt::solve
