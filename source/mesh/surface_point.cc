// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/surface_point.h"

namespace tetradapt::mesh
{
  namespace
  {
    /** Barycentric coordinates of a point of a face. */
    std::array<double, 3>
    face_coordinates(const TetMesh &mesh, const BoundaryFace &face, const Point<3> &point)
    {
      const Tensor<1, 3>    area = face_area_vector(mesh, face);
      const double          size = area.norm_square();
      std::array<double, 3> b;
      for (unsigned int i = 0; i < 3; ++i)
        {
          const Point<3> &next = mesh.points[face.vertices[(i + 1) % 3]],
                         &last = mesh.points[face.vertices[(i + 2) % 3]];
          b[i] = 0.5 * (dealii::cross_product_3d(next - point, last - point) * area) / size;
        }
      return b;
    }
  } // namespace

  SurfacePoint
  surface_point(const TetMesh &mesh, const unsigned int face, const Point<3> &point)
  {
    if (!has_curved_faces(mesh))
      {
        const Tensor<1, 3> area = face_area_vector(mesh, mesh.faces[face]);
        return {point, area / area.norm()};
      }
    const auto        b      = face_coordinates(mesh, mesh.faces[face], point);
    const CurvedFace &curved = mesh.curved_faces[face];
    Point<3>          x;
    Tensor<1, 3>      n;
    for (unsigned int i = 0; i < 3; ++i)
      {
        const double corner = b[i] * (2. * b[i] - 1.), middle = 4. * b[i] * b[(i + 1) % 3];
        x += corner * Tensor<1, 3>(curved.points[i]);
        x += middle * Tensor<1, 3>(curved.points[3 + i]);
        n += corner * curved.normals[i] + middle * curved.normals[3 + i];
      }
    return {x, n / n.norm()};
  }
} // namespace tetradapt::mesh
