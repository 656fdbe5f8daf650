// SPDX-License-Identifier: AGPL-3.0-or-later
#include "goal_assembly.h"

#include "tetradapt/compare/parallel.h"

namespace tetradapt::estimate
{
  using dealii::SymmetricTensor;

  GoalAssembly::GoalAssembly(const mesh::NodalField       &field,
                             const HierarchicalSurplus    *surplus,
                             const mechanics::MaterialMap &materials)
    : field(field), surplus(surplus), materials(materials),
      forces(3
               * (static_cast<std::size_t>(field.n_nodes())
                  + (surplus == nullptr ? 0 : surplus->n_functions())),
             0.)
  {
  }

  void
  GoalAssembly::add_force(unsigned int cell, const mesh::Barycentric &b, const Tensor<1, 3> &force)
  {
    double shapes[10];
    mesh::shape_values(field.degree(), b, shapes);
    for (unsigned int i = 0; i < field.n_nodes_per_cell(); ++i)
      add(field.node(cell, i), shapes[i] * force);
    if (surplus == nullptr)
      return;
    HierarchicalSurplus::values(field.degree(), b, shapes);
    const auto signs = surplus->signs(cell);
    for (unsigned int i = 0; i < surplus->n_per_cell(); ++i)
      add(field.n_nodes() + surplus->function(cell, i), signs[i] * shapes[i] * force);
  }

  void
  GoalAssembly::add_stress(unsigned int                 cell,
                           const mesh::Barycentric     &b,
                           const SymmetricTensor<2, 3> &S)
  {
    const mesh::TetMesh &mesh   = field.mesh();
    const int            region = mesh.regions[cell];
    const Tensor<2, 3>   dual(materials.linear_law(region).stress(Tensor<2, 3>(S))); // C : S
    const auto           directions = mesh::barycentric_gradients(mesh, cell);
    Tensor<1, 3>         gradients[10];
    mesh::shape_gradients(field.degree(), b, directions, gradients);
    for (unsigned int i = 0; i < field.n_nodes_per_cell(); ++i)
      add(field.node(cell, i), dual * gradients[i]);
    if (materials.has_thermal_strain())
      {
        Point<3> x;
        for (unsigned int i = 0; i < 4; ++i)
          x += b[i] * Tensor<1, 3>(mesh.points[mesh.cells[cell][i]]);
        offset -= scalar_product(dual, Tensor<2, 3>(materials.thermal_strain(region, x)));
      }
    if (surplus == nullptr)
      return;
    HierarchicalSurplus::gradients(field.degree(), b, directions, gradients);
    const auto signs = surplus->signs(cell);
    for (unsigned int i = 0; i < surplus->n_per_cell(); ++i)
      add(field.n_nodes() + surplus->function(cell, i), signs[i] * (dual * gradients[i]));
  }

  GoalFunctional
  GoalAssembly::finish(double measure, MPI_Comm communicator)
  {
    GoalFunctional result;
    result.forces = std::move(forces);
    result.forces.push_back(offset);
    compare::sum_over_ranks(result.forces, communicator);
    for (double &force : result.forces)
      force /= measure;
    result.offset = result.forces.back();
    result.forces.pop_back();
    return result;
  }
} // namespace tetradapt::estimate
