// SPDX-License-Identifier: AGPL-3.0-or-later
//
// Internal forces of laws that are not linear against differences of the stored energy, the
// tangent's product (assembled and matrix-free, in both precisions, and at degree 1 of a degree
// 2) against differences of the forces, what is not admissible, and laws that remember. On
// several ranks the sums are those of one.

#include "tetradapt/mechanics/nonlinear_stiffness.h"
#include "tetradapt/fem/replication.h"
#include "tetradapt/fem/triangulation.h"
#include "tetradapt/laws/linear_elastic.h"
#include "tetradapt/mechanics/matrix_free_stiffness.h"
#include "tetradapt/mechanics/stiffness.h"

#include "bodies.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/affine_constraints.h>

using namespace bodies;
using fem::Vector;

namespace
{
  scene::Scene
  two_laws()
  {
    scene::Scene scene;
    scene.formulation            = scene::Formulation::finite_strain;
    scene.materials              = {material("soft", 10., 0.3), material("hard", 1., 0.)};
    scene.materials[0].law       = "neo-Hookean";
    scene.materials[1].law       = "split neo-Hookean";
    scene.materials[1].constants = {{"Shear modulus", 20.}, {"Bulk modulus", 50.}};
    scene.materials[1].regions   = {1};
    return scene;
  }

  /** The same function of the place on every rank. */
  Vector
  displacement(const fem::Space &space, const double amount, const double seed)
  {
    Vector u(space.vector_layout());
    for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
      {
        const unsigned int field_node = space.field_node(node);
        const auto        &mesh       = space.tet_mesh();
        Point<3>           x;
        if (field_node < mesh.n_points())
          x = mesh.points[field_node];
        else
          {
            const auto &edge = space.edge_table()->edges[field_node - mesh.n_points()];
            x = mesh.points[edge[0]] + 0.5 * (mesh.points[edge[1]] - mesh.points[edge[0]]);
          }
        for (unsigned int c = 0; c < 3; ++c)
          u.local_element(3 * node + c)
            = amount * std::sin(seed + 1.7 * x[0] + (2.1 + c) * x[1] - 1.3 * x[2] * (1. + c));
      }
    return u;
  }

  void
  say(const std::string &what, const double error, const double tolerance)
  {
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) != 0)
      return;
    std::cout << "  " << what << ": ";
    if (error <= tolerance)
      std::cout << "right\n";
    else
      std::cout << "WRONG by " << error << '\n';
  }

  void
  check_degree(const unsigned int degree)
  {
    const auto         body  = box(Point<3>(2., 1., 1.), {{3, 2, 2}}, 0.2, 1.);
    const scene::Scene scene = two_laws();
    const auto         edges = mesh::build_edges(*body);
    const auto triangulation = std::make_shared<const fem::Triangulation>(body, MPI_COMM_WORLD);
    const fem::Space                    space(triangulation, degree);
    const mechanics::MaterialMap        materials(scene, *body);
    const mechanics::NonlinearStiffness stiffness(space, materials);

    const Vector u = displacement(space, 0.1, 0.), v = displacement(space, 1., 2.);
    Vector       forces, ahead, behind;
    const double h = 1e-5;
    Vector       plus(u), minus(u);
    plus.add(h, v);
    minus.add(-h, v);
    const auto   at            = stiffness.internal_forces(u, forces);
    const double energy_ahead  = stiffness.internal_forces(plus, ahead).stored_energy;
    const double energy_behind = stiffness.internal_forces(minus, behind).stored_energy;
    say("forces by the energy",
        std::abs((energy_ahead - energy_behind) / (2. * h) - forces * v),
        1e-8 * forces.l2_norm() * v.l2_norm());

    Vector difference(ahead);
    difference -= behind;
    difference /= 2. * h;
    const mechanics::TangentField tangents = stiffness.linearise(u);
    fem::Constraints              none     = fem::make_constraints(space);
    none.close();
    const fem::FixedUnknowns fixed(space, none);
    Vector                   product(space.vector_layout());
    const auto               system = mechanics::assemble(space, tangents, fixed);
    system.matrix.vmult(product, v);
    const Vector assembled = product;
    product -= difference;
    say("assembled tangent by the forces", product.l2_norm(), 1e-8 * difference.l2_norm());
    if (degree == 2)
      {
        const mechanics::MatrixFreeStiffness<double> matrix_free(space, tangents, fixed);
        matrix_free.vmult(product, v);
        product -= assembled;
        say("matrix-free tangent", product.l2_norm(), 1e-13 * difference.l2_norm());
        double worst = 0.;
        for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
          for (unsigned int i = 0; i < 9; ++i)
            worst = std::max(worst,
                             std::abs(matrix_free.diagonal_blocks()[node][i]
                                      - system.matrix.block(system.matrix.row_begin(node))[i]));
        say("its diagonal blocks", dealii::Utilities::MPI::max(worst, MPI_COMM_WORLD), 1e-11);
        const mechanics::MatrixFreeStiffness<float> single(space, tangents, fixed, 1e-2);
        mechanics::VectorOf<float> x(space.vector_layout()), y(space.vector_layout());
        for (unsigned int i = 0; i < x.locally_owned_size(); ++i)
          x.local_element(i) = v.local_element(i);
        single.vmult(y, x);
        for (unsigned int i = 0; i < x.locally_owned_size(); ++i)
          product.local_element(i) = 100. * y.local_element(i) - assembled.local_element(i);
        say("in single precision", product.l2_norm(), 1e-5 * difference.l2_norm());

        // The matrix of degree 1 is that of degree 2 in the subspace.
        const auto       linear = fem::Space::linear_part(space);
        fem::Constraints free   = fem::make_constraints(*linear);
        free.close();
        const auto coarse
          = mechanics::assemble(*linear, tangents, fem::FixedUnknowns(*linear, free));
        Vector     w(linear->vector_layout()), image(linear->vector_layout());
        const auto field = fem::replicate(space, v);
        auto       whole = field;
        for (unsigned int e = 0; e < edges.edges.size(); ++e)
          whole[body->n_points() + e] = 0.5 * (field[edges.edges[e][0]] + field[edges.edges[e][1]]);
        const Vector fine = fem::distribute(space, whole);
        for (unsigned int node = 0; node < linear->n_owned_nodes(); ++node)
          for (unsigned int c = 0; c < 3; ++c)
            w.local_element(3 * node + c) = field[linear->field_node(node)][c];
        coarse.matrix.vmult(image, w);
        system.matrix.vmult(product, fine);
        const double energy = product * fine;
        say("degree 1 of it", std::abs(image * w - energy), 1e-12 * std::abs(energy));
      }

    // Pushed through itself, the body has no response.
    Vector inverted(u);
    inverted = 0.;
    for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
      if (space.field_node(node) == 0)
        inverted.local_element(3 * node) = 5.;
    const auto bad = stiffness.internal_forces(inverted, forces);
    say("inside out is not admissible", bad.is_admissible ? 1. : 0., 0.);
    say("least determinant", bad.least_jacobian < 0. ? 0. : 1., 0.);
    say("where", (bad.worst_place - Point<3>()).norm(), 1.);
    say("before, it is", at.is_admissible && at.least_jacobian > 0. ? 0. : 1., 0.);
    if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
      {
        std::cout.precision(9);
        std::cout << "  energy " << at.stored_energy << ", least determinant " << at.least_jacobian
                  << '\n';
      }
  }

  /** Remembers the largest stretch along x, and what it was before. */
  class Remembering : public laws::LinearElastic
  {
  public:
    Remembering() : LinearElastic(1., 0.)
    {
    }
    unsigned int
    n_history() const override
    {
      return 1;
    }
    bool
    update(const Tensor<2, 3> &G,
           laws::History       history,
           bool                with_tangent,
           laws::Response     &r) const override
    {
      history.after[0] = std::max(history.before[0], G[0][0]);
      LinearElastic::update(G, history, with_tangent, r);
      // What was stretched stays softer.
      const double softer = 1. / (1. + history.after[0]);
      r.energy *= softer;
      r.stress *= softer;
      return true;
    }
  };

  void
  check_history()
  {
    mechanics::MaterialHistory history({1, 0, 2}, 4);
    for (unsigned int q = 0; q < 4; ++q)
      {
        history.at(0, q).after[0] = q;
        history.at(2, q).after[0] = 10. + q;
        history.at(2, q).after[1] = 20. + q;
      }
    const bool untouched = history.at(2, 3).before[1] == 0.;
    history.accept();
    history.at(0, 2).after[0] = 99.;
    std::cout << "history: before " << untouched << ", after "
              << (history.at(0, 2).before[0] == 2. && history.at(2, 3).before[0] == 13.
                  && history.at(2, 0).before[1] == 20.)
              << ", none " << (history.at(1, 0).before == nullptr) << '\n';
    // A law that is asked one state after the other.
    const Remembering law;
    laws::Response    r;
    const auto        stretched = [](const double e) {
      Tensor<2, 3> G;
      G[0][0] = e;
      return G;
    };
    mechanics::MaterialHistory one({law.n_history()}, 1);
    law.update(stretched(1.), one.at(0, 0), false, r);
    one.accept();
    law.update(stretched(0.5), one.at(0, 0), false, r);
    check("stress after it was stretched more", r.stress[0][0], 0.25, 1., 1e-15);
  }
} // namespace

int
main(int argc, char **argv)
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const unsigned int degree : {1u, 2u})
    {
      if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
        std::cout << "degree " << degree << '\n';
      check_degree(degree);
    }
  if (dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0)
    check_history();
}
