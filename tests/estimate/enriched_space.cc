// SPDX-License-Identifier: AGPL-3.0-or-later
//
// The space of the next degree: its fields are continuous, complete, and its stiffness
// is what quadrature gives.

#include "tetradapt/compare/tet_quadrature.h"
#include "tetradapt/estimate/enriched/space.h"
#include "tetradapt/mesh/face_table.h"

#include "../solve/solving.h"

#include <deal.II/base/mpi.h>

using namespace bodies;
using estimate::EnrichedSpace;
using estimate::HierarchicalSurplus;

namespace
{
  using Values = EnrichedSpace::Values;

  Values
  random_values(const std::size_t size)
  {
    Values        values(size);
    std::uint64_t state = 7;
    for (double &value : values)
      {
        state = state * 6364136223846793005ULL + 1442695040888963407ULL;
        value = 2. * (state >> 11) / 9007199254740992. - 1.;
      }
    return values;
  }

  /** An element of the enriched space, evaluated by its definition. */
  struct Field
  {
    const EnrichedSpace    &space;
    const mesh::NodalField &nodal;
    const Values           &values;

    Tensor<1, 3>
    coefficient(const unsigned int function) const
    {
      return Tensor<1, 3>(
        {values[3 * function], values[3 * function + 1], values[3 * function + 2]});
    }

    Tensor<1, 3>
    value(const unsigned int cell, const mesh::Barycentric &b) const
    {
      double shape[10], surplus[10];
      mesh::shape_values(nodal.degree(), b, shape);
      HierarchicalSurplus::values(nodal.degree(), b, surplus);
      const auto   signs = space.surplus().signs(cell);
      Tensor<1, 3> sum;
      for (unsigned int i = 0; i < nodal.n_nodes_per_cell(); ++i)
        sum += shape[i] * coefficient(nodal.node(cell, i));
      for (unsigned int i = 0; i < space.surplus().n_per_cell(); ++i)
        sum += signs[i] * surplus[i]
               * coefficient(space.n_nodes() + space.surplus().function(cell, i));
      return sum;
    }

    Tensor<2, 3>
    gradient(const unsigned int cell, const mesh::Barycentric &b) const
    {
      Tensor<1, 3> shape[10], surplus[10];
      const auto   directions = mesh::barycentric_gradients(nodal.mesh(), cell);
      mesh::shape_gradients(nodal.degree(), b, directions, shape);
      HierarchicalSurplus::gradients(nodal.degree(), b, directions, surplus);
      const auto   signs = space.surplus().signs(cell);
      Tensor<2, 3> sum;
      for (unsigned int i = 0; i < nodal.n_nodes_per_cell(); ++i)
        sum += outer_product(coefficient(nodal.node(cell, i)), shape[i]);
      for (unsigned int i = 0; i < space.surplus().n_per_cell(); ++i)
        sum += signs[i]
               * outer_product(coefficient(space.n_nodes() + space.surplus().function(cell, i)),
                               surplus[i]);
      return sum;
    }
  };

  /** Largest jump of a field across the inner faces. */
  double
  largest_jump(const Field &field)
  {
    const auto &mesh       = field.nodal.mesh();
    const auto  neighbours = mesh::cell_neighbors(mesh);
    double      largest    = 0.;
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      for (unsigned int f = 0; f < 4; ++f)
        if (neighbours[cell][f] < mesh.n_cells())
          {
            mesh::Barycentric b{{0., 0., 0., 0.}};
            Point<3>          x;
            for (unsigned int k = 0; k < 3; ++k)
              {
                const unsigned int v = mesh::face_vertices[f][k];
                b[v]                 = 0.2 + 0.1 * k + (k == 2 ? 0.1 : 0.);
                x += b[v] * (mesh.points[mesh.cells[cell][v]] - Point<3>());
              }
            const auto other = mesh::barycentric_coordinates(mesh, neighbours[cell][f], x);
            largest
              = std::max(largest,
                         (field.value(cell, b) - field.value(neighbours[cell][f], other)).norm());
          }
    return largest;
  }

  void
  test(const unsigned int degree)
  {
    scene::Scene scene;
    scene.materials                   = {material("left", 3., 0.2), material("right", 1., 0.45)};
    scene.materials[1].regions        = {1};
    const auto                   body = box(Point<3>(2, 1, 1), {{5, 3, 3}}, 0.2, 0.8);
    const mechanics::MaterialMap materials(scene, *body);
    const mesh::NodalField       nodal(body, degree);
    const EnrichedSpace          space(nodal, materials, MPI_COMM_WORLD);
    const Values                 x = random_values(space.size());
    Values                       y = x;
    std::reverse(y.begin(), y.end());
    const Field u{space, nodal, x}, v{space, nodal, y};

    std::cout << "P" << degree << ": " << space.n_nodes() << " nodes, "
              << space.surplus().n_functions() << " functions of the surplus\n";
    check("  continuous", largest_jump(u) < 1e-12);

    const auto         &rule = compare::tet_quadrature(degree == 1 ? 2 : 4);
    std::vector<double> products(body->n_cells(), 0.);
    double              sum = 0., size = 0.;
    for (unsigned int cell = 0; cell < body->n_cells(); ++cell)
      {
        const auto &law = materials.linear_law(body->regions[cell]);
        for (unsigned int q = 0; q < rule.points.size(); ++q)
          products[cell] += mesh::cell_volume(*body, cell) * rule.weights[q]
                            * (law.stress(u.gradient(cell, rule.points[q]))
                               * symmetrize(v.gradient(cell, rule.points[q])));
        sum += products[cell];
        size += std::abs(products[cell]);
      }
    const auto computed = space.cell_products(x, y);
    double     worst    = 0.;
    for (unsigned int cell = 0; cell < body->n_cells(); ++cell)
      worst = std::max(worst, std::abs(computed[cell] - products[cell]));
    check("  energy products of cells", worst < 1e-12 * size);

    Values forces;
    space.multiply(x, forces);
    double product = 0.;
    for (std::size_t i = 0; i < space.size(); ++i)
      product += forces[i] * y[i];
    check("  energy product", product, sum, size, 1e-12);

    const std::vector<double> diagonal = space.surplus_diagonal();
    double                    largest = 0., error = 0.;
    for (const unsigned int function : {0u, 100u, space.surplus().n_functions() - 1})
      for (unsigned int c = 0; c < 3; ++c)
        {
          Values unit(space.size());
          unit[3 * (space.n_nodes() + function) + c] = 1.;
          space.multiply(unit, forces);
          for (unsigned int d = 0; d < 3; ++d)
            {
              const double exact = forces[3 * (space.n_nodes() + function) + d];
              error   = std::max(error, std::abs(diagonal[9 * function + 3 * c + d] - exact));
              largest = std::max(largest, std::abs(exact));
            }
        }
    check("  diagonal", error < 1e-12 * largest);
  }

  /** A polynomial of the next degree is prescribed exactly on its faces. */
  void
  prescribed(const unsigned int degree)
  {
    scene::Scene scene;
    scene.materials = {material("all", 1., 0.3)};
    scene.supports  = {support("x", "x < 1e-9", "xz", {{"3 + y*z", "7", "x - y*y"}}),
                       support("y", "x > 2 - 1e-9", "y")};
    if (degree == 2)
      scene.supports[0].displacement = {{"y*y*z - 2*z^3", "7", "y*z*z + y^3 + y"}};
    auto body = box(Point<3>(2, 1, 1), {{3, 2, 2}});
    select(*body, scene);
    const mechanics::MaterialMap materials(scene, *body);
    mesh::NodalField             nodal(body, degree);
    const auto                   nodes
      = mechanics::prescribe(scene.supports, *body, degree == 2 ? &nodal.edges() : nullptr);
    nodal.values = nodes.values;
    const EnrichedSpace space(nodal, materials, MPI_COMM_WORLD);
    const auto          extra   = estimate::prescribe_surplus(scene.supports, space.surplus());
    Values              values  = space.embed(nodal.values);
    unsigned int        n_fixed = 0;
    for (unsigned int i = 0; i < space.surplus().n_functions(); ++i)
      for (unsigned int c = 0; c < 3; ++c)
        {
          values[3 * (space.n_nodes() + i) + c] = extra.values[i][c];
          n_fixed += extra.is_fixed(i, c);
        }
    const Field                  u{space, nodal, values};
    const core::VectorExpression exact(scene.supports[0].displacement, "exact");
    double                       error = 0.;
    for (unsigned int f = 0; f < body->faces.size(); ++f)
      if (body->patches[body->faces[f].patch].selections == std::vector<std::string>{"Supports/x"})
        {
          const unsigned int slot = space.surplus().faces().boundary_slots[f];
          mesh::Barycentric  b{{0.5, 0.3, 0.2, 0.}};
          std::swap(b[3], b[slot % 4]);
          Point<3> x;
          for (unsigned int i = 0; i < 4; ++i)
            x += b[i] * (body->points[body->cells[slot / 4][i]] - Point<3>());
          for (const unsigned int c : {0, 2})
            error = std::max(error, std::abs((u.value(slot / 4, b) - exact(x))[c]));
        }
    std::cout << "P" << degree << ", supports: " << n_fixed << " coefficients\n";
    check("  exact on the faces", error < 1e-12);
  }
} // namespace

int
main(int argc, char *argv[])
{
  const dealii::Utilities::MPI::MPI_InitFinalize mpi(argc, argv, 1);
  for (const unsigned int degree : {1, 2})
    {
      test(degree);
      prescribed(degree);
    }
}
