// SPDX-License-Identifier: AGPL-3.0-or-later
#include "stress_conditions.h"

#include "tetradapt/compare/field_evaluator.h"
#include "tetradapt/mesh/true_surface.h"

#include <algorithm>

namespace tetradapt::estimate
{
  namespace
  {
    using Face = StressConditions::Face;

    /** Adds a row of the least-squares system: row . sigma = value at point @p q. */
    void
    add_matrix(Face &face, const double *row)
    {
      for (unsigned int a = 0; a < 6; ++a)
        for (unsigned int b = 0; b < 6; ++b)
          face.matrix[a][b] += StressConditions::boundary_weight * row[a] * row[b];
    }

    void
    add_right(Face &face, const unsigned int q, const double *row, const double value)
    {
      for (unsigned int a = 0; a < 6; ++a)
        face.right[q][a] += StressConditions::boundary_weight * row[a] * value;
    }

    /** (sigma n)_c = t_c */
    void
    add_traction(Face               &face,
                 const unsigned int  c,
                 const Tensor<1, 3> &normal,
                 const Tensor<1, 3> (&tractions)[3])
    {
      double row[6] = {0., 0., 0., 0., 0., 0.};
      for (unsigned int d = 0; d < 3; ++d)
        row[stress_index[c][d]] = normal[d];
      add_matrix(face, row);
      for (unsigned int q = 0; q < face.n_points; ++q)
        add_right(face, q, row, tractions[q][c]);
    }

    /** d . sigma n = d . t */
    void
    add_traction_along(Face               &face,
                       const Tensor<1, 3> &d,
                       const Tensor<1, 3> &normal,
                       const Tensor<1, 3> (&tractions)[3])
    {
      double row[6] = {0., 0., 0., 0., 0., 0.};
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          row[stress_index[i][j]] += d[i] * normal[j];
      add_matrix(face, row);
      for (unsigned int q = 0; q < face.n_points; ++q)
        add_right(face, q, row, d * tractions[q]);
    }

    /** 2 mu (t_1 t_2) : C^-1 (sigma - sigma_h) = 0 */
    void
    add_tangential_strain(Face                  &face,
                          const Tensor<1, 3>    &t1,
                          const Tensor<1, 3>    &t2,
                          const ElasticMatrices &matrices,
                          const double (&stresses)[3][6])
    {
      // Engineering shears: sigma_xy's strain counts for both xy and yx.
      const double direction[6] = {t1[0] * t2[0],
                                   t1[1] * t2[1],
                                   t1[2] * t2[2],
                                   .5 * (t1[0] * t2[1] + t1[1] * t2[0]),
                                   .5 * (t1[0] * t2[2] + t1[2] * t2[0]),
                                   .5 * (t1[1] * t2[2] + t1[2] * t2[1])};
      double       row[6];
      for (unsigned int b = 0; b < 6; ++b)
        {
          row[b] = 0.;
          for (unsigned int a = 0; a < 6; ++a)
            row[b] += 2. * matrices.shear_modulus * direction[a] * matrices.compliance[a][b];
        }
      add_matrix(face, row);
      for (unsigned int q = 0; q < face.n_points; ++q)
        {
          double value = 0.;
          for (unsigned int a = 0; a < 6; ++a)
            value += row[a] * stresses[q][a];
          add_right(face, q, row, value);
        }
    }

    /** The conditions of the points of boundary face @p f of @p cell, each with its own normal
     * on the body's true surface. */
    void
    add_curved_face(const unsigned int f,
                    const Face        &flat,
                    const GivenLoads  &loads,
                    std::vector<Face> &faces)
    {
      const unsigned char known = loads.known_components(f);
      for (unsigned int q = 0; q < flat.n_points; ++q)
        {
          Face face{};
          face.local_face = flat.local_face;
          face.n_points   = 1;
          face.corner     = flat.n_points == 1 ? dealii::numbers::invalid_unsigned_int : q;
          const mesh::SurfacePoint at = loads.surface().at(f, flat.points[q]);
          face.points[0]              = at.point;
          Tensor<1, 3> tractions[3];
          if (loads.has_traction(f))
            tractions[0] = loads.surface_traction(f, at);
          for (unsigned int c = 0; c < 3; ++c)
            if ((known >> c & 1) != 0)
              add_traction(face, c, at.normal, tractions);
          if (loads.slides(f))
            for (const Tensor<1, 3> &d : loads.known_directions(f, at.normal))
              add_traction_along(face, d, at.normal, tractions);
          faces.push_back(face);
        }
    }

    void
    add_face(const mesh::TetMesh &mesh,
             const unsigned int   f,
             const unsigned int   cell,
             const unsigned int   degree,
             const CellStress    &stress,
             const GivenLoads    &loads,
             std::vector<Face>   &faces)
    {
      Face face{};
      face.corner = dealii::numbers::invalid_unsigned_int;
      for (unsigned int i = 0; i < 4; ++i)
        {
          const auto &points = mesh.faces[f].vertices;
          if (std::find(points.begin(), points.end(), mesh.cells[cell][i]) == points.end())
            face.local_face = i;
        }
      std::array<unsigned int, 3> v;
      for (unsigned int i = 0; i < 3; ++i)
        v[i] = mesh.cells[cell][mesh::face_vertices[face.local_face][i]];
      face.n_points             = degree == 1 ? 1 : 3;
      const Tensor<1, 3> n      = mesh::face_area_vector(mesh, mesh.faces[f]);
      const Tensor<1, 3> normal = n / n.norm();
      for (unsigned int q = 0; q < face.n_points; ++q)
        for (unsigned int i = 0; i < 3; ++i)
          face.points[q] += (degree == 1 ? 1. / 3.
                             : i == q    ? 2. / 3.
                                         : 1. / 6.)
                            * Tensor<1, 3>(mesh.points[v[i]]);

      const unsigned char known = loads.known_components(f);
      if ((known != 0 || loads.slides(f)) && loads.surface().is_projected(f))
        return add_curved_face(f, face, loads, faces);
      if (known != 0 || loads.slides(f))
        {
          Tensor<1, 3> tractions[3];
          if (loads.has_traction(f))
            for (unsigned int q = 0; q < face.n_points; ++q)
              tractions[q] = loads.traction(f, face.points[q], normal);
          if (loads.slides(f))
            for (const Tensor<1, 3> &d : loads.known_directions(f, normal))
              add_traction_along(face, d, normal, tractions);
          for (unsigned int c = 0; c < 3; ++c)
            if ((known >> c & 1) != 0)
              add_traction(face, c, normal, tractions);
        }
      if (loads.held_components(f) == 7)
        {
          double stresses[3][6];
          for (unsigned int q = 0; q < face.n_points; ++q)
            stress.at(cell,
                      mesh::barycentric_coordinates(mesh, cell, face.points[q]),
                      face.points[q],
                      stresses[q]);
          Tensor<1, 3> t1 = mesh.points[v[1]] - mesh.points[v[0]];
          t1 /= t1.norm();
          const Tensor<1, 3> t2 = dealii::cross_product_3d(normal, t1);
          add_tangential_strain(face, t1, t1, stress.materials()[cell], stresses);
          add_tangential_strain(face, t2, t2, stress.materials()[cell], stresses);
          add_tangential_strain(face, t1, t2, stress.materials()[cell], stresses);
        }
      faces.push_back(face);
    }
  } // namespace

  void
  StressConditions::Face::right_at(const mesh::Barycentric &b, double *result) const
  {
    std::fill(result, result + 6, 0.);
    for (unsigned int q = 0; q < n_points; ++q)
      {
        const double weight
          = n_points == 1 ? 1. : 2. * b[mesh::face_vertices[local_face][q]] - 1. / 3.;
        for (unsigned int a = 0; a < 6; ++a)
          result[a] += weight * right[q][a];
      }
  }

  StressConditions::StressConditions(const mesh::NodalField &u_h,
                                     const CellStress       &stress,
                                     const RecoveryPatches  &patches,
                                     const GivenLoads       &loads)
    : on_boundary(u_h.mesh().n_points(), 0), on_curved_wall(on_boundary),
      begin(u_h.mesh().n_cells() + std::size_t(1), 0)
  {
    const mesh::TetMesh                               &mesh = u_h.mesh();
    std::vector<std::pair<unsigned int, unsigned int>> order; // of cells, then faces
    for (unsigned int f = 0; f < mesh.faces.size(); ++f)
      {
        order.emplace_back(patches.cell_of_face(mesh, f), f);
        const bool is_curved = loads.surface().is_projected(f);
        for (const unsigned int v : mesh.faces[f].vertices)
          {
            on_boundary[v] = 1;
            if (is_curved)
              on_curved_wall[v] = 1;
          }
      }
    std::sort(order.begin(), order.end());
    faces.reserve(order.size());
    for (const auto &[cell, f] : order)
      {
        const std::size_t before = faces.size();
        add_face(mesh, f, cell, u_h.degree(), stress, loads, faces);
        begin[cell + 1] += faces.size() - before;
      }
    for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
      begin[cell + 1] += begin[cell];

    if (loads.has_body_force())
      {
        forces.resize(mesh.n_cells());
        for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
          forces[cell]
            = loads.body_force(cell, compare::position(mesh, cell, {{.25, .25, .25, .25}}));
      }
  }
} // namespace tetradapt::estimate
