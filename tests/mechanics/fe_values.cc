// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The operators against the same form integrated with deal.II's FEValues on the space's
// DoFHandler, and against its MatrixFree: a curved body in two materials, on several ranks. Then
// with faces that slide, whose constraints are deal.II's AffineConstraints.

#include "tetradapt/fem/triangulation.h"
#include "tetradapt/mechanics/matrix_free_stiffness.h"
#include "tetradapt/mechanics/stiffness.h"
#include "tetradapt/mechanics/supports.h"

#include "bodies.h"

#include <deal.II/base/mpi.h>
#include <deal.II/base/quadrature_lib.h>
#include <deal.II/dofs/dof_accessor.h>
#include <deal.II/dofs/dof_handler.h>
#include <deal.II/dofs/dof_tools.h>
#include <deal.II/fe/fe_simplex_p.h>
#include <deal.II/fe/fe_values.h>
#include <deal.II/fe/mapping_fe.h>
#include <deal.II/lac/affine_constraints.h>
#include <deal.II/matrix_free/fe_evaluation.h>
#include <deal.II/matrix_free/matrix_free.h>

using namespace bodies;
using namespace mechanics;

namespace
{
  bool is_first_rank = false;

  void
  check_small(const std::string &what, const double value, const double tolerance)
  {
    const double largest = dealii::Utilities::MPI::max(value, MPI_COMM_WORLD);
    if (is_first_rank)
      check(what, largest, 0., 1., tolerance);
  }

  /** A box bent about the y axis, with cells of all shapes. */
  std::shared_ptr<mesh::TetMesh>
  bent_body()
  {
    auto body = box(Point<3>(3, 1, 1), {{6, 3, 2}}, 0.3, 1.5);
    for (auto &p : body->points)
      p = Point<3>((2. + p[2]) * std::sin(0.5 * p[0]), p[1], (2. + p[2]) * std::cos(0.5 * p[0]));
    mesh::finalize(*body, "bent box");
    return body;
  }

  /** A vector with ghosts for all relevant unknowns, as FEValues need them. */
  Vector
  ghosted(const fem::Space &space, const Vector &x)
  {
#if DEAL_II_VERSION_GTE(9, 5, 0)
    const auto relevant = dealii::DoFTools::extract_locally_relevant_dofs(space.dof_handler());
#else
    dealii::IndexSet relevant;
    dealii::DoFTools::extract_locally_relevant_dofs(space.dof_handler(), relevant);
#endif
    Vector result(space.dof_handler().locally_owned_dofs(), relevant, space.communicator());
    result.copy_locally_owned_data_from(x);
    result.update_ghost_values();
    return result;
  }

  /** forces_i = sum over own cells of int stress(x) : grad phi_i. */
  Vector
  by_fe_values(const fem::Space &space, const MaterialMap &materials, const Vector &x)
  {
    const dealii::FEValuesExtractors::Vector u(0);
    const auto                              &element = space.dof_handler().get_fe();
    const dealii::MappingFE<3>               mapping(dealii::FE_SimplexP<3>(1));
    dealii::FEValues<3>                      fe_values(mapping,
                                  element,
                                  dealii::QGaussSimplex<3>(space.degree()),
                                  dealii::update_gradients | dealii::update_JxW_values);
    const Vector                             values = ghosted(space, x);
    Vector                                   forces(values);
    forces = 0.;
    std::vector<dealii::types::global_dof_index> dofs(element.n_dofs_per_cell());
    std::vector<Tensor<2, 3>>                    gradients(fe_values.n_quadrature_points);
    for (const auto &cell : space.dof_handler().active_cell_iterators())
      if (cell->is_locally_owned())
        {
          fe_values.reinit(cell);
          fe_values[u].get_function_gradients(values, gradients);
          cell->get_dof_indices(dofs);
          for (unsigned int q = 0; q < gradients.size(); ++q)
            {
              const auto stress = materials.linear_law(cell->material_id()).stress(gradients[q]);
              for (unsigned int i = 0; i < dofs.size(); ++i)
                forces[dofs[i]]
                  += stress * fe_values[u].symmetric_gradient(i, q) * fe_values.JxW(q);
            }
        }
    forces.compress(dealii::VectorOperation::add);
    return forces;
  }

  /** The same with MatrixFree, whose cells have one material here. */
  Vector
  by_matrix_free(const fem::Space &space, const LinearLaw &law, const Vector &x)
  {
    using Number = double;
    using Form   = dealii::MatrixFree<3, Number>;
    Form                              form;
    dealii::AffineConstraints<Number> none;
    none.close();
    Form::AdditionalData data;
    data.mapping_update_flags = dealii::update_gradients | dealii::update_JxW_values;
    form.reinit(dealii::MappingFE<3>(dealii::FE_SimplexP<3>(1)),
                space.dof_handler(),
                none,
                dealii::QGaussSimplex<3>(space.degree()),
                data);
    Vector values, forces;
    form.initialize_dof_vector(values);
    form.initialize_dof_vector(forces);
    values.copy_locally_owned_data_from(x);
    // lambda and mu
    const auto   tangent = law.tangent_at_rest();
    const double lambda = tangent[0][0][1][1], mu = tangent[0][1][0][1];
    const std::function<
      void(const Form &, Vector &, const Vector &, const std::pair<unsigned int, unsigned int> &)>
      add_cells = [&](const Form &f, Vector &to, const Vector &from, const auto &range) {
        dealii::FEEvaluation<3, -1, 0, 3, Number> u(f);
        for (unsigned int cell = range.first; cell < range.second; ++cell)
          {
            u.reinit(cell);
            u.gather_evaluate(from, dealii::EvaluationFlags::gradients);
            for (unsigned int q = 0; q < u.n_q_points; ++q)
              {
                const auto strain = u.get_symmetric_gradient(q);
                auto       stress = 2. * mu * strain;
                const auto p      = lambda * trace(strain);
                for (unsigned int d = 0; d < 3; ++d)
                  stress[d][d] += p;
                u.submit_symmetric_gradient(stress, q);
              }
            u.integrate_scatter(dealii::EvaluationFlags::gradients, to);
          }
      };
    form.cell_loop(add_cells, forces, values, true);
    return forces;
  }

  double
  difference(const Vector &a, const Vector &b)
  {
    Vector error(a);
    error.zero_out_ghost_values();
    for (unsigned int i = 0; i < b.locally_owned_size(); ++i)
      error.local_element(i) -= b.local_element(i);
    return error.linfty_norm() / b.linfty_norm();
  }
  /** Supports that slide along a curved wall and along cuts; where they meet, a node is held in
   * two directions, and in three where a component is fixed also. */
  scene::Scene
  sliding_scene()
  {
    scene::Scene scene;
    scene.materials            = {material("soft", 10., 0.4), material("hard", 1000., 0.2)};
    scene.materials[1].regions = {1};
    scene.supports             = {support("wall", "x^2 + z^2 > 8.5"),
                                  support("cuts", "x < 1e-9 || abs(x - z*tan(1.5)) < 1e-9*z"),
                                  support("side", "y < 1e-9", "y", {{"0", "0.02*x", "0"}})};
    for (unsigned int s = 0; s < 2; ++s)
      scene.supports[s].type = scene::SupportType::sliding;
    scene.supports[0].normal_displacement = "0.01 + 0.1*y";
    return scene;
  }

  /** The residual of a displacement that fulfils the constraints is that of FEValues in the
   * directions that are free, and zero in the others. */
  void
  check_sliding(const std::shared_ptr<mesh::TetMesh> &body,
                const mesh::EdgeTable                &edges,
                const unsigned int                    degree)
  {
    const scene::Scene scene    = sliding_scene();
    const auto         selected = std::make_shared<mesh::TetMesh>(*body);
    select(*selected, scene);
    const MaterialMap  materials(scene, *selected);
    const TangentField tangents(materials, *selected);
    const auto triangulation = std::make_shared<const fem::Triangulation>(selected, MPI_COMM_WORLD);
    const fem::Space space(triangulation, degree);
    const auto       prescribed
      = prescribe(scene.supports, *selected, degree == 1 ? nullptr : &edges, scene.mesh);
    const fem::Constraints   constraints = make_constraints(prescribed, space);
    const fem::FixedUnknowns fixed(space, constraints);
    Vector                   u(space.vector_layout()), product(u);
    for (const auto i : u.locally_owned_elements())
      u[i] = std::sin(1. + i);
    fixed.distribute(u);
    Vector distributed(u);
    constraints.distribute(distributed);
    const std::string name = "sliding, degree " + std::to_string(degree);
    check_small(name + ", AffineConstraints", difference(distributed, u), 1e-13);

    Vector       expected(space.vector_layout());
    const Vector forces = by_fe_values(space, materials, u);
    for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
      {
        Tensor<1, 3> force;
        for (unsigned int c = 0; c < 3; ++c)
          force[c] = -forces.local_element(3 * node + c);
        force = fixed.free_part(node, force);
        for (unsigned int c = 0; c < 3; ++c)
          expected.local_element(3 * node + c) = force[c];
      }
    const Vector       no_forces(space.vector_layout());
    const LinearSystem system = assemble(space, tangents, fixed);
    system.matrix.vmult(product, u);
    Vector residual = right_hand_side(system, space, fixed, no_forces);
    residual -= product;
    check_small(name + ", assembled", difference(residual, expected), 1e-13);
    if (degree == 1)
      return;
    const MatrixFreeStiffness<double> matrix_free(space, tangents, fixed);
    matrix_free.vmult(product, u);
    residual = matrix_free.right_hand_side(no_forces);
    residual -= product;
    check_small(name + ", kernel", difference(residual, expected), 1e-13);
    system.matrix.vmult(residual, distributed);
    check_small(name + ", kernel and assembled", difference(product, residual), 1e-13);
    const unsigned int n_inclined
      = dealii::Utilities::MPI::sum(static_cast<unsigned int>(fixed.inclined().size()),
                                    MPI_COMM_WORLD);
    if (is_first_rank)
      check(name + ", some nodes are inclined", n_inclined > 20);
  }
} // namespace

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  is_first_rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;

  const auto            body  = bent_body();
  const mesh::EdgeTable edges = mesh::build_edges(*body);
  scene::Scene          scene;
  scene.materials            = {material("soft", 10., 0.4), material("hard", 1000., 0.2)};
  scene.materials[1].regions = {1};
  for (const bool one_material : {false, true})
    for (const unsigned int degree : {1u, 2u})
      {
        if (one_material)
          std::fill(body->regions.begin(), body->regions.end(), 1);
        const MaterialMap  materials(scene, *body);
        const TangentField tangents(materials, *body);
        const auto         body_of_materials
          = std::make_shared<const fem::Triangulation>(body, MPI_COMM_WORLD);
        const fem::Space         space(body_of_materials, degree);
        const fem::FixedUnknowns none(space, fem::make_constraints(space));
        Vector                   x(space.vector_layout()), y(x);
        for (const auto i : x.locally_owned_elements())
          x[i] = std::sin(1. + i);
        const std::string  name   = "degree " + std::to_string(degree);
        const LinearSystem system = assemble(space, tangents, none);
        system.matrix.vmult(y, x);
        if (!one_material)
          check_small(name + ", assembled, with FEValues",
                      difference(y, by_fe_values(space, materials, x)),
                      1e-13);
        else
          check_small(name + ", assembled, with MatrixFree",
                      difference(y, by_matrix_free(space, materials.linear_law(1), x)),
                      1e-13);
        if (degree == 1)
          continue;
        const MatrixFreeStiffness<double> matrix_free(space, tangents, none);
        matrix_free.vmult(y, x);
        if (!one_material)
          check_small(name + ", kernel, with FEValues",
                      difference(y, by_fe_values(space, materials, x)),
                      1e-13);
        else
          check_small(name + ", kernel, with MatrixFree",
                      difference(y, by_matrix_free(space, materials.linear_law(1), x)),
                      1e-13);
      }
  for (const unsigned int degree : {1u, 2u})
    check_sliding(bent_body(), edges, degree);
}
