// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The matrix-free stiffness equals the assembled one, for every form of tangents, with
// mixed supports, two materials and cells of all shapes, on one rank and on two.

#include "tetradapt/fem/replication.h"
#include "tetradapt/fem/triangulation.h"
#include "tetradapt/mechanics/matrix_free_stiffness.h"
#include "tetradapt/mechanics/stiffness.h"
#include "tetradapt/mechanics/supports.h"

#include "bodies.h"

#include <deal.II/base/mpi.h>
#include <deal.II/lac/affine_constraints.h>

using namespace bodies;
using namespace mechanics;

namespace
{
  bool is_first_rank = false;

  void
  check_small(const std::string &what, double value, double tolerance)
  {
    value = dealii::Utilities::MPI::max(value, MPI_COMM_WORLD);
    if (is_first_rank)
      check(what, value, 0., 1., tolerance);
  }

  /** Something on every unknown, the same whatever the number of ranks. */
  template <typename Number>
  void
  fill(const fem::Space &space, VectorOf<Number> &x)
  {
    for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
      for (unsigned int c = 0; c < 3; ++c)
        x.local_element(3 * node + c) = std::sin(1. + 3. * space.field_node(node) + c);
  }

  template <typename Number>
  double
  difference(const VectorOf<Number> &a, const Vector &b)
  {
    double largest = 0., scale = 0.;
    for (unsigned int i = 0; i < b.locally_owned_size(); ++i)
      {
        largest = std::max(largest, std::abs(a.local_element(i) - b.local_element(i)));
        scale   = std::max(scale, std::abs(b.local_element(i)));
      }
    return largest / scale;
  }

  template <typename Number>
  void
  compare(const std::string        &name,
          const fem::Space         &space,
          const TangentField       &tangents,
          const fem::FixedUnknowns &fixed,
          const double              tolerance)
  {
    const LinearSystem                assembled = assemble(space, tangents, fixed);
    const MatrixFreeStiffness<Number> matrix_free(space, tangents, fixed);
    VectorOf<Number>                  x(space.vector_layout()), y(x);
    Vector                            X(space.vector_layout()), Y(X);
    fill(space, x);
    fill(space, X);
    matrix_free.vmult(y, x);
    assembled.matrix.vmult(Y, X);
    check_small(name + ": product", difference(y, Y), tolerance);
    fill(space, Y);
    check_small("  the argument is as before", difference(x, Y), tolerance);

    double worst = 0., scale = 0.;
    for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
      for (unsigned int i = 0; i < 9; ++i)
        {
          const double entry = assembled.matrix.block(assembled.matrix.row_begin(node))[i];
          worst = std::max(worst, std::abs(matrix_free.diagonal_blocks()[node][i] - entry));
          scale = std::max(scale, std::abs(entry));
        }
    check_small("  diagonal blocks", worst / scale, tolerance);

    std::vector<Tensor<1, 3>> values(space.n_field_nodes());
    for (unsigned int i = 0; i < values.size(); ++i)
      values[i] = Tensor<1, 3>({std::sin(i), std::cos(i), 1.});
    const Vector forces = fem::distribute(space, values);
    check_small("  right-hand side",
                difference(matrix_free.right_hand_side(forces),
                           right_hand_side(assembled, space, fixed, forces)),
                tolerance);
  }

  /** A stiffness without symmetry planes: positive, since it is C + v v. */
  SymmetricTensor<4, 3>
  anisotropic(const LinearLaw &law, double seed)
  {
    SymmetricTensor<2, 3> v;
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int j = 0; j <= i; ++j)
        v[i][j] = 20. * std::sin(seed + 3. * i + j);
    return law.tangent_at_rest() + dealii::outer_product(v, v);
  }
} // namespace

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  is_first_rank = dealii::Utilities::MPI::this_mpi_process(MPI_COMM_WORLD) == 0;

  scene::Scene scene;
  scene.materials            = {material("soft", 10., 0.4), material("hard", 1000., 0.2)};
  scene.materials[1].regions = {1};
  scene.supports             = {support("wall", "x < 1e-9", "xyz", {{"0", "0.01*z", "0"}}),
                                support("rail", "y < 1e-9 && x > 1", "y", {{"0", "0.1", "0"}})};
  const auto body            = box(Point<3>(3, 1, 1), {{7, 3, 3}}, 0.3, 1.5);
  select(*body, scene);
  const MaterialMap materials(scene, *body);
  const auto triangulation       = std::make_shared<const fem::Triangulation>(body, MPI_COMM_WORLD);
  const mesh::EdgeTable    edges = mesh::build_edges(*body);
  const fem::Space         space(triangulation, 2);
  const fem::FixedUnknowns fixed(space,
                                 make_constraints(prescribe(scene.supports, *body, &edges), space));

  const TangentField at_rest(materials, *body);
  compare<double>("one isotropic tangent a region", space, at_rest, fixed, 1e-13);
  compare<float>("  in single precision", space, at_rest, fixed, 1e-5);

  std::vector<SymmetricTensor<4, 3>> tensors;
  std::vector<unsigned int>          one, four;
  for (unsigned int i = 0; i < 5; ++i)
    tensors.push_back(anisotropic(materials.linear_law(i % 2), i));
  for (unsigned int cell = 0; cell < body->n_cells(); ++cell)
    {
      one.push_back(cell % 5);
      for (unsigned int q = 0; q < 4; ++q)
        four.push_back((cell + q) % 5);
    }
  compare<double>("one a cell", space, TangentField(tensors, one, 1), fixed, 1e-13);
  compare<double>("one a point", space, TangentField(tensors, four, 4), fixed, 1e-13);

  // The matrix of degree 1 is that of degree 2 on linear displacements.
  const fem::Space                  linear(triangulation, 1);
  const TangentField                tangents(tensors, four, 4);
  const fem::FixedUnknowns          none(linear, fem::make_constraints(linear));
  const LinearSystem                coarse = assemble(linear, tangents, none);
  const MatrixFreeStiffness<double> fine(space,
                                         tangents,
                                         fem::FixedUnknowns(space, fem::make_constraints(space)));
  Vector                            x(linear.vector_layout()), y(x), X(space.vector_layout()), Y(X);
  fill(linear, x);
  for (unsigned int node = 0; node < space.n_owned_nodes(); ++node)
    for (unsigned int c = 0; c < 3; ++c)
      {
        const auto value = [&](unsigned int point) { return std::sin(1. + 3. * point + c); };
        const unsigned int field_node = space.field_node(node);
        X.local_element(3 * node + c)
          = field_node < body->n_points()
              ? value(field_node)
              : 0.5
                  * (value(edges.edges[field_node - body->n_points()][0])
                     + value(edges.edges[field_node - body->n_points()][1]));
      }
  coarse.matrix.vmult(y, x);
  fine.vmult(Y, X);
  const double energy = x * y, finer = X * Y;
  check_small("energy in degree 1", std::abs(energy - finer) / finer, 1e-12);
}
