// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/enriched/enriched_problem.h"

#include "tetradapt/compare/parallel.h"
#include "tetradapt/compare/tet_quadrature.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/core/failure.h"
#include "tetradapt/estimate/given_loads.h"
#include "tetradapt/fem/replication.h"
#include "tetradapt/solve/conjugate_gradients.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/full_matrix.h>

#include <cmath>

namespace tetradapt::estimate
{
  namespace
  {
    using Values = EnrichedSpace::Values;

    /** A residual that is this small, relative to the forces, is none. */
    constexpr double rounding = 1e-14;

    /** A residual, relative to the forces, with which estimates on any number of ranks agree to
     * 1e-8: energies are wrong by the square of the error. The estimated error will not do, since
     * on few unknowns it is a rough one. With springs the part of theirs is wrong by the error
     * itself. */
    constexpr double independent_of_ranks = 1e-5, independent_with_springs = 1e-7;

    /** Adds the loads' forces on the surplus; those on the nodes are known. Loads are sampled
     * as for the solution. */
    class SurplusLoads
    {
    public:
      SurplusLoads(const scene::Scene           &scene,
                   const mechanics::MaterialMap &materials,
                   const EnrichedSpace          &space)
        : loads(scene, materials, space.surplus().mesh()), materials(materials), space(space),
          surplus(space.surplus()), mesh(surplus.mesh())
      {
      }

      void
      add_faces(Values &forces) const
      {
        const auto slice = compare::own_slice(mesh.faces.size(), space.communicator());
        double     shapes[HierarchicalSurplus::max_per_cell];
        for (unsigned int f = slice.begin; f < slice.end; ++f)
          if (loads.has_traction(f))
            {
              const unsigned int slot = surplus.faces().boundary_slots[f], cell = slot / 4;
              const double       area = mesh::face_area_vector(mesh, mesh.faces[f]).norm();
              loads.sample_face(
                f, [&](const std::array<double, 3> &b, double weight, const Tensor<1, 3> &value) {
                  HierarchicalSurplus::values(surplus.degree(), on_face(cell, f, b), shapes);
                  add(cell, shapes, weight * area * value, forces);
                });
            }
      }

      void
      add_cells(Values &forces) const
      {
        if (!loads.has_body_force() && !materials.has_thermal_strain())
          return;
        const auto slice = compare::own_slice(mesh.n_cells(), space.communicator());
        mechanics::VolumeDensity::Samples samples;
        double                            shapes[HierarchicalSurplus::max_per_cell];
        Tensor<1, 3>                      gradients[HierarchicalSurplus::max_per_cell];
        for (unsigned int cell = slice.begin; cell < slice.end; ++cell)
          {
            const auto   directions = mesh::barycentric_gradients(mesh, cell);
            const double volume     = mesh::cell_volume(mesh, cell);
            loads.sample_cell(
              cell, [&](const mesh::Barycentric &b, double weight, const Tensor<1, 3> &value) {
                HierarchicalSurplus::values(surplus.degree(), b, shapes);
                add(cell, shapes, volume * weight * value, forces);
              });
            if (!materials.has_thermal_strain())
              continue;
            materials.thermal_density().sample(mesh, cell, samples);
            for (const auto &point : samples)
              {
                HierarchicalSurplus::gradients(surplus.degree(), point.b, directions, gradients);
                add(cell,
                    gradients,
                    volume * point.weight * thermal_stress(cell, point.value[0]),
                    forces);
              }
          }
      }

    private:
      mesh::Barycentric
      on_face(unsigned int cell, unsigned int f, const std::array<double, 3> &weights) const
      {
        mesh::Barycentric b{{0., 0., 0., 0.}};
        for (unsigned int i = 0; i < 4; ++i)
          for (unsigned int k = 0; k < 3; ++k)
            if (mesh.cells[cell][i] == mesh.faces[f].vertices[k])
              b[i] = weights[k];
        return b;
      }

      /** The stress that would hold the thermal strain back. */
      Tensor<2, 3>
      thermal_stress(unsigned int cell, const double strain) const
      {
        return Tensor<2, 3>(materials.linear_law(mesh.regions[cell])
                              .stress(strain * Tensor<2, 3>(dealii::unit_symmetric_tensor<3>())));
      }

      /** Adds factor times (value or gradient) of each function: force times values, or
       * stress times gradients. */
      template <typename Shape, typename Factor>
      void
      add(unsigned int cell, const Shape *shapes, const Factor &factor, Values &forces) const
      {
        const auto signs = surplus.signs(cell);
        for (unsigned int i = 0; i < surplus.n_per_cell(); ++i)
          {
            const std::size_t  function = space.n_nodes() + surplus.function(cell, i);
            const Tensor<1, 3> force    = signs[i] * (factor * shapes[i]);
            for (unsigned int c = 0; c < 3; ++c)
              forces[3 * function + c] += force[c];
          }
      }

      const GivenLoads              loads;
      const mechanics::MaterialMap &materials;
      const EnrichedSpace          &space;
      const HierarchicalSurplus    &surplus;
      const mesh::TetMesh          &mesh;
    };

    std::vector<double>
    inverse_blocks(std::vector<double> blocks)
    {
      dealii::FullMatrix<double> block(3, 3);
      for (std::size_t first = 0; first < blocks.size(); first += 9)
        {
          for (unsigned int i = 0; i < 9; ++i)
            block(i / 3, i % 3) = blocks[first + i];
          block.gauss_jordan();
          for (unsigned int i = 0; i < 9; ++i)
            blocks[first + i] = block(i / 3, i % 3);
        }
      return blocks;
    }

    const solve::StaticSystem &
    system_of(const solve::StaticSolution &solution)
    {
      if (solution.system == nullptr)
        throw core::InputError("A solution in the space of the next degree is asked for, but the "
                               "system that was solved has not been kept.");
      return *solution.system;
    }
  } // namespace

  EnrichedProblem::EnrichedProblem(const EstimateInput &input)
    : system(system_of(input.solution)), displacement(input.comparison.displacement()),
      stopping(input.scene.solver.stopping), springs(input.scene, displacement.mesh()),
      enriched_space(displacement,
                     input.comparison.material_map(),
                     input.comparison.mpi_communicator(),
                     &springs),
      prescribed(
        prescribe_surplus(input.scene.supports, enriched_space.surplus(), input.scene.mesh))
  {
    const MPI_Comm     communicator = input.comparison.mpi_communicator();
    Values             extra(enriched_space.size());
    const SurplusLoads surplus_loads(input.scene, input.comparison.material_map(), enriched_space);
    core::together(communicator, [&] {
      surplus_loads.add_faces(extra);
      surplus_loads.add_cells(extra);
    });
    compare::sum_over_ranks(extra.data(), extra.size(), communicator);
    loads = enriched_space.embed(fem::replicate(*system.space(), system.nodal_forces()));
    loads += extra;
    loads += enriched_space.ground_forces();
  }

  Values
  EnrichedProblem::supported_solution() const
  {
    Values             u     = enriched_space.embed(displacement.values);
    const unsigned int first = enriched_space.n_nodes();
    for (unsigned int i = 0; i < enriched_space.surplus().n_functions(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
        u[3 * static_cast<std::size_t>(first + i) + c] = prescribed.values[i][c];
    return u;
  }

  void
  EnrichedProblem::clear_supported(Values &forces) const
  {
    const auto clear
      = [&forces](const mechanics::PrescribedDisplacement &supports, std::size_t first) {
          for (unsigned int i = 0; i < supports.fixed.size(); ++i)
            if (supports.fixed[i] != 0)
              for (unsigned int c = 0; c < 3; ++c)
                if (supports.is_fixed(i, c))
                  forces[3 * (first + i) + c] = 0.;
          for (const auto &[node, held] : supports.inclined)
            {
              Tensor<1, 3> force;
              for (unsigned int c = 0; c < 3; ++c)
                force[c] = forces[3 * (first + node) + c];
              force -= held * force;
              for (unsigned int c = 0; c < 3; ++c)
                forces[3 * (first + node) + c] = force[c];
            }
        };
    clear(system.prescribed(), 0);
    clear(prescribed, enriched_space.n_nodes());
  }

  Values
  EnrichedProblem::residual(const Values &u) const
  {
    Values result;
    enriched_space.multiply(u, result);
    result.sadd(-1., 1., loads);
    clear_supported(result);
    return result;
  }

  void
  EnrichedProblem::precondition(const Values &residual, Values &result) const
  {
    const std::size_t n_nodes = enriched_space.n_nodes();
    nodal_residual.resize(n_nodes);
    for (std::size_t i = 0; i < n_nodes; ++i)
      for (unsigned int c = 0; c < 3; ++c)
        nodal_residual[i][c] = residual[3 * i + c];
    fem::Vector nodal_part;
    system.precondition(fem::distribute(*system.space(), nodal_residual), nodal_part);
    const std::vector<Tensor<1, 3>> nodal_result = fem::replicate(*system.space(), nodal_part);
    result.reinit(residual, true);
    for (std::size_t i = 0; i < n_nodes; ++i)
      for (unsigned int c = 0; c < 3; ++c)
        result[3 * i + c] = nodal_result[i][c];

    if (block_inverses.empty()) // not every caller comes here
      block_inverses = inverse_blocks(enriched_space.surplus_diagonal());
    const double *r = residual.data() + 3 * n_nodes;
    double       *z = result.data() + 3 * n_nodes;
    for (const double *b = block_inverses.data(), *end = b + block_inverses.size(); b != end;
         b += 9, r += 3, z += 3)
      for (unsigned int c = 0; c < 3; ++c)
        z[c] = b[3 * c] * r[0] + b[3 * c + 1] * r[1] + b[3 * c + 2] * r[2];
    clear_supported(result);
  }

  /** The stiffness in the space of free functions. */
  struct EnrichedProblem::FreeStiffness
  {
    const EnrichedProblem &problem;

    void
    vmult(Values &forces, const Values &x) const
    {
      problem.enriched_space.multiply(x, forces);
      problem.clear_supported(forces);
    }
  };

  struct EnrichedProblem::AdditivePreconditioner
  {
    const EnrichedProblem &problem;

    void
    vmult(Values &result, const Values &residual) const
    {
      problem.precondition(residual, result);
    }
  };

  EnrichedProblem::Correction
  EnrichedProblem::solve(const Values &forces, double tolerance) const
  {
    solve::IterationLimits limits;
    const bool             by_residual = stopping == scene::SolverParameters::Stopping::residual;
    limits.residual                    = forces.l2_norm()
                      * (!by_residual      ? rounding
                         : springs.empty() ? independent_of_ranks
                                           : independent_with_springs);
    limits.relative_error = by_residual ? 0. : tolerance;
    limits.max_iterations = 500; // tens are usual, at Poisson ratios near 0.5, too
    solve::EnergyControl control(limits);
    Correction           result;
    result.values.reinit(forces);
    const solve::Ending ending = solve::conjugate_gradients(
      FreeStiffness{*this}, AdditivePreconditioner{*this}, forces, control, result.values);
    const solve::IterationResult reached = control.result();
    // Where it takes too many steps to be independent of the ranks, or where all that is left is
    // rounding, as of an exact solution, what an estimate needs will do.
    const bool is_enough = ending != solve::Ending::not_finite
                           && reached.error <= tolerance * std::sqrt(reached.gained);
    if (ending != solve::Ending::converged && !is_enough)
      throw core::NumericalError(
        "The solution of the next degree, which an error estimator needs, did not converge in "
        + std::to_string(reached.iterations)
        + " iterations. Look for materials of very different stiffness, a Poisson ratio close to "
          "0.5 or very flat elements, or choose another estimator in Estimation.");
    result.norm         = std::sqrt(reached.gained);
    result.error        = reached.residual > limits.residual ? reached.error : 0.;
    result.n_iterations = reached.iterations;
    result.missing      = result.norm > 0. ? std::pow(result.error / result.norm, 2) : 0.;
    if (by_residual && result.norm > 0.)
      {
        // The square of the norm of what is sought for is 2 F(e) - a(e, e), up to the square of the
        // error. Single precision in the preconditioner leaves terms of first order in a(e, e).
        Values product;
        enriched_space.multiply(result.values, product);
        const double all        = result.values * product;
        double       of_springs = 0.;
        if (const auto *matrix = enriched_space.spring_matrix())
          {
            product = 0.;
            matrix->add_product(result.values.data(), product.data());
            of_springs = result.values * product;
          }
        const double body = all - of_springs, more = 2. * (result.values * forces - all);
        result.missing = body > 0. ? std::max(-1., more / body) : 0.;
      }
    return result;
  }
} // namespace tetradapt::estimate
