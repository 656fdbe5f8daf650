// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/nodal_field.h"

#include "tetradapt/core/exceptions.h"

namespace tetradapt::mesh
{
  NodalField::NodalField(std::shared_ptr<const TetMesh>   mesh,
                         const unsigned int               degree,
                         std::shared_ptr<const EdgeTable> edges)
    : mesh_pointer(std::move(mesh)), edge_pointer(std::move(edges)), polynomial_degree(degree)
  {
    if (!mesh_pointer)
      throw core::InputError("A nodal field needs a mesh.");
    if (degree != 1 && degree != 2)
      throw core::InputError("A displacement of polynomial degree " + std::to_string(degree)
                             + " is asked for; 1 and 2 exist.");
    if (degree == 1)
      edge_pointer.reset();
    else if (!edge_pointer)
      edge_pointer = std::make_shared<const EdgeTable>(build_edges(*mesh_pointer));
    else if (edge_pointer->cell_edges.size() != mesh_pointer->cells.size())
      throw core::InputError("The edge table given to a nodal field is of another mesh.");
    values.resize(mesh_pointer->n_points() + (degree == 2 ? edge_pointer->edges.size() : 0));
  }



  Point<3>
  NodalField::node_position(const unsigned int n) const
  {
    if (n < mesh_pointer->n_points())
      return mesh_pointer->points[n];
    const auto &edge = edge_pointer->edges[n - mesh_pointer->n_points()];
    Point<3>    middle;
    for (unsigned int d = 0; d < 3; ++d)
      middle[d] = 0.5 * (mesh_pointer->points[edge[0]][d] + mesh_pointer->points[edge[1]][d]);
    return middle;
  }



  Tensor<1, 3>
  NodalField::value(const unsigned int cell, const Barycentric &b) const
  {
    double shape[10];
    shape_values(polynomial_degree, b, shape);
    const unsigned int n = n_nodes_per_cell();
    Tensor<1, 3>       sum;
    for (unsigned int i = 0; i < n; ++i)
      sum += shape[i] * values[node(cell, i)];
    return sum;
  }



  Tensor<2, 3>
  NodalField::gradient(const unsigned int cell, const Barycentric &b) const
  {
    Tensor<1, 3> shape[10];
    shape_gradients(polynomial_degree, b, barycentric_gradients(*mesh_pointer, cell), shape);
    const unsigned int n = n_nodes_per_cell();
    Tensor<2, 3>       sum;
    for (unsigned int k = 0; k < n; ++k)
      {
        const Tensor<1, 3> &u = values[node(cell, k)];
        for (unsigned int i = 0; i < 3; ++i)
          for (unsigned int j = 0; j < 3; ++j)
            sum[i][j] += u[i] * shape[k][j];
      }
    return sum;
  }



  std::array<Tensor<1, 3>, 4>
  barycentric_gradients(const TetMesh &mesh, const unsigned int cell)
  {
    const auto        &vertices = mesh.cells[cell];
    const Point<3>    &p        = mesh.points[vertices[0]];
    const Tensor<1, 3> a        = mesh.points[vertices[1]] - p;
    const Tensor<1, 3> b        = mesh.points[vertices[2]] - p;
    const Tensor<1, 3> c        = mesh.points[vertices[3]] - p;

    // grad b_i is normal to the opposite face; its product with the edge from
    // there to vertex i is one.
    const Tensor<1, 3>          bc = dealii::cross_product_3d(b, c);
    const double                f  = 1. / (a * bc);
    std::array<Tensor<1, 3>, 4> gradients;
    gradients[1] = f * bc;
    gradients[2] = f * dealii::cross_product_3d(c, a);
    gradients[3] = f * dealii::cross_product_3d(a, b);
    gradients[0] = -(gradients[1] + gradients[2] + gradients[3]);
    return gradients;
  }



  Barycentric
  barycentric_coordinates(const TetMesh &mesh, const unsigned int cell, const Point<3> &p)
  {
    const auto        &vertices = mesh.cells[cell];
    const Point<3>    &origin   = mesh.points[vertices[0]];
    const Tensor<1, 3> a        = mesh.points[vertices[1]] - origin;
    const Tensor<1, 3> b        = mesh.points[vertices[2]] - origin;
    const Tensor<1, 3> c        = mesh.points[vertices[3]] - origin;
    const Tensor<1, 3> r        = p - origin;

    const Tensor<1, 3> bc = dealii::cross_product_3d(b, c);
    const Tensor<1, 3> ra = dealii::cross_product_3d(r, a);
    const double       f  = 1. / (a * bc);
    const double       b1 = f * (r * bc);
    const double       b2 = -f * (ra * c);
    const double       b3 = f * (ra * b);
    return {{1. - b1 - b2 - b3, b1, b2, b3}};
  }



  void
  shape_values(const unsigned int degree, const Barycentric &b, double *values)
  {
    if (degree == 1)
      {
        for (unsigned int i = 0; i < 4; ++i)
          values[i] = b[i];
        return;
      }
    for (unsigned int i = 0; i < 4; ++i)
      values[i] = b[i] * (2. * b[i] - 1.);
    for (unsigned int e = 0; e < 6; ++e)
      values[4 + e] = 4. * b[edge_vertices[e][0]] * b[edge_vertices[e][1]];
  }



  void
  shape_gradients(const unsigned int                 degree,
                  const Barycentric                 &b,
                  const std::array<Tensor<1, 3>, 4> &barycentric_gradients,
                  Tensor<1, 3>                      *gradients)
  {
    if (degree == 1)
      {
        for (unsigned int i = 0; i < 4; ++i)
          gradients[i] = barycentric_gradients[i];
        return;
      }
    for (unsigned int i = 0; i < 4; ++i)
      gradients[i] = (4. * b[i] - 1.) * barycentric_gradients[i];
    for (unsigned int e = 0; e < 6; ++e)
      {
        const auto &[i, j] = edge_vertices[e];
        gradients[4 + e] = 4. * (b[i] * barycentric_gradients[j] + b[j] * barycentric_gradients[i]);
      }
  }
} // namespace tetradapt::mesh
