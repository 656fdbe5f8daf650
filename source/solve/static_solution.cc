// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/static_solution.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/mechanics/loads.h"
#include "tetradapt/mechanics/stiffness.h"
#include "tetradapt/solve/energies.h"
#include "tetradapt/solve/linear_solver.h"

#include <deal.II/base/mpi.h>

namespace tetradapt::solve
{
  namespace
  {
    using mechanics::DisplacementSpace;

    /** First iterate: the start where there is one, and the prescribed values. */
    Vector
    first_iterate(const DisplacementSpace                 &space,
                  const mechanics::PrescribedDisplacement &prescribed,
                  const mesh::NodalField                  *start)
    {
      Vector x(space.vector_layout());
      for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
        {
          const unsigned int field_node = space.field_node(node);
          for (unsigned int c = 0; c < 3; ++c)
            if (prescribed.is_fixed(field_node, c))
              x.local_element(3 * node + c) = prescribed.values[field_node][c];
            else if (start != nullptr)
              x.local_element(3 * node + c) = start->values[field_node][c];
        }
      return x;
    }

    double
    work(const DisplacementSpace                 &space,
         const std::vector<dealii::Tensor<1, 3>> &forces,
         const std::vector<dealii::Tensor<1, 3>> &displacement)
    {
      double sum = 0.;
      for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
        sum += forces[space.field_node(node)] * displacement[space.field_node(node)];
      return dealii::Utilities::MPI::sum(sum, space.communicator());
    }
  } // namespace

  StaticSolution
  solve_static(const scene::Scene                  &scene,
               const mechanics::MaterialMap        &materials,
               std::shared_ptr<const mesh::TetMesh> mesh,
               unsigned int                         degree,
               MPI_Comm                             communicator,
               const core::Log                     &log,
               const mesh::NodalField              *start)
  {
    StaticSolution solution;
    solution.displacement        = std::make_shared<mesh::NodalField>(mesh, degree);
    auto                  &field = *solution.displacement;
    const mesh::EdgeTable *edges = degree == 2 ? &field.edges() : nullptr;

    log.progress("supports and numbering");
    const auto                     prescribed = mechanics::prescribe(scene.supports, *mesh, edges);
    const mechanics::MeshPartition partition(*mesh, communicator);
    const DisplacementSpace        space(partition, degree, edges);
    solution.n_dofs = space.n_dofs();

    log.progress("assembling " + std::to_string(space.n_dofs()) + " unknowns");
    const auto forces = mechanics::nodal_forces(scene, materials, space);
    const auto system = mechanics::assemble(space, materials, prescribed, &forces);

    Vector            x = first_iterate(space, prescribed, start);
    const LinearModel model{partition, space, materials, prescribed};
    const auto        result = solve_linear(model, system, scene.solver, log, x);
    solution.iterations      = result.iterations;
    solution.solver          = result.description;

    space.gather(x, field.values);
    const Energies energies = compute_energies(field, materials, communicator);
    solution.energy         = energies.energy;
    solution.strain_energy  = energies.stored;
    solution.external_work  = work(space, forces, field.values);
    return solution;
  }
} // namespace tetradapt::solve
