// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/tet_mesh.h"

#include <algorithm>

namespace tetradapt::mesh
{
  double
  cell_volume(const TetMesh &mesh, const unsigned int cell)
  {
    const auto        &vertices = mesh.cells[cell];
    const Point<3>    &p        = mesh.points[vertices[0]];
    const Tensor<1, 3> a        = mesh.points[vertices[1]] - p;
    const Tensor<1, 3> b        = mesh.points[vertices[2]] - p;
    const Tensor<1, 3> c        = mesh.points[vertices[3]] - p;
    return dealii::cross_product_3d(a, b) * c / 6.;
  }



  double
  total_volume(const TetMesh &mesh)
  {
    // A million terms lose five digits in double precision.
    long double volume = 0.;
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      volume += cell_volume(mesh, cell);
    return static_cast<double>(volume);
  }



  Tensor<1, 3>
  face_area_vector(const TetMesh &mesh, const BoundaryFace &face)
  {
    const Point<3> &p = mesh.points[face.vertices[0]];
    return 0.5
           * dealii::cross_product_3d(mesh.points[face.vertices[1]] - p,
                                      mesh.points[face.vertices[2]] - p);
  }



  std::pair<Point<3>, Point<3>>
  bounding_box(const TetMesh &mesh)
  {
    if (mesh.points.empty())
      return {};
    Point<3> lower = mesh.points[0];
    Point<3> upper = mesh.points[0];
    for (const Point<3> &point : mesh.points)
      for (unsigned int d = 0; d < 3; ++d)
        {
          lower[d] = std::min(lower[d], point[d]);
          upper[d] = std::max(upper[d], point[d]);
        }
    return {lower, upper};
  }
} // namespace tetradapt::mesh
