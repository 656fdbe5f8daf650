// SPDX-License-Identifier: AGPL-3.0-or-later
// A linear field is reproduced with degree 1, a quadratic one with degree 2,
// values and gradients, anywhere in distorted cells.

#include "tetradapt/mesh/nodal_field.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/mesh/bricks.h"

#include <cmath>
#include <iostream>
#include <random>

using namespace tetradapt;
using namespace tetradapt::mesh;

/** u(x) = a + B x + q(x) with a quadratic part for degree 2, and its gradient. */
void
exact(const unsigned int degree, const Point<3> &p, Tensor<1, 3> &u, Tensor<2, 3> &gradient)
{
  const double x = p[0], y = p[1], z = p[2], s = degree - 1.;
  u[0] = 1. + 2. * x - y + 3. * z + s * (x * x + 2. * x * y - z * z);
  u[1] = -2. + x + 5. * y - z + s * (3. * y * z - 0.5 * y * y);
  u[2] = 0.5 - 4. * x + 2. * z + s * (x * z + 2. * z * z - 7. * x * x);

  const double G[3][3] = {{2. + s * (2. * x + 2. * y), -1. + s * 2. * x, 3. - s * 2. * z},
                          {1., 5. + s * (3. * z - y), -1. + s * 3. * y},
                          {-4. + s * (z - 14. * x), 0., 2. + s * (x + 4. * z)}};
  for (unsigned int i = 0; i < 3; ++i)
    for (unsigned int j = 0; j < 3; ++j)
      gradient[i][j] = G[i][j];
}

void
test(const unsigned int degree)
{
  std::mt19937                           random(7);
  std::uniform_real_distribution<double> uniform(0., 1.);

  auto mesh = std::make_shared<TetMesh>(bricks({-1., 0., 0.}, {1., 1., 3.}, {{3, 2, 4}}));
  for (auto &point : mesh->points)
    for (unsigned int d = 0; d < 3; ++d)
      point[d] += 0.1 * (uniform(random) - 0.5);

  NodalField   field(mesh, degree);
  Tensor<1, 3> u;
  Tensor<2, 3> gradient;
  for (unsigned int n = 0; n < field.n_nodes(); ++n)
    exact(degree, field.node_position(n), field.values[n], gradient);

  double worst_value = 0., worst_gradient = 0., worst_coordinate = 0., worst_sum = 0.;
  for (unsigned int c = 0; c < mesh->n_cells(); ++c)
    for (unsigned int k = 0; k < 4; ++k)
      {
        // Also beyond the cell: polynomials go on there.
        Barycentric b{{uniform(random), uniform(random), uniform(random), 0.}};
        b[3] = 1. - b[0] - b[1] - b[2];
        Point<3> p;
        for (unsigned int i = 0; i < 4; ++i)
          p += b[i] * Tensor<1, 3>(mesh->points[mesh->cells[c][i]]);
        exact(degree, p, u, gradient);
        worst_value            = std::max(worst_value, (field.value(c, b) - u).norm());
        worst_gradient         = std::max(worst_gradient, (field.gradient(c, b) - gradient).norm());
        const Barycentric back = barycentric_coordinates(*mesh, c, p);
        for (unsigned int i = 0; i < 4; ++i)
          worst_coordinate = std::max(worst_coordinate, std::abs(back[i] - b[i]));

        double       shape[10], sum = 0.;
        Tensor<1, 3> shape_gradient[10], gradient_sum;
        shape_values(degree, b, shape);
        shape_gradients(degree, b, barycentric_gradients(*mesh, c), shape_gradient);
        for (unsigned int i = 0; i < field.n_nodes_per_cell(); ++i)
          {
            sum += shape[i];
            gradient_sum += shape_gradient[i];
          }
        worst_sum = std::max({worst_sum, std::abs(sum - 1.), gradient_sum.norm()});
      }
  std::cout << "degree " << degree << ": " << field.n_nodes() << " nodes, "
            << field.n_nodes_per_cell() << " a cell; exact to 1e-11: values "
            << (worst_value < 1e-11) << ", gradients " << (worst_gradient < 1e-11)
            << ", coordinates " << (worst_coordinate < 1e-11) << ", sums " << (worst_sum < 1e-11)
            << std::endl;
  if (degree == 1)
    return;

  // Degree 1 cannot do this: the error must show, or nothing was compared.
  NodalField linear(mesh, 1);
  for (unsigned int n = 0; n < linear.n_nodes(); ++n)
    exact(2, mesh->points[n], linear.values[n], gradient);
  const Barycentric centre{{0.25, 0.25, 0.25, 0.25}};
  Point<3>          p;
  for (unsigned int i = 0; i < 4; ++i)
    p += 0.25 * Tensor<1, 3>(mesh->points[mesh->cells[0][i]]);
  exact(2, p, u, gradient);
  std::cout << "degree 1 differs: " << ((linear.value(0, centre) - u).norm() > 1e-3) << std::endl;
}

int
main()
{
  test(1);
  test(2);
  try
    {
      NodalField(std::make_shared<TetMesh>(), 3);
      std::cout << "NOT REFUSED" << std::endl;
    }
  catch (const core::InputError &error)
    {
      std::cout << error.what() << std::endl;
    }
}
