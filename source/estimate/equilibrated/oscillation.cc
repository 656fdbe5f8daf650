// SPDX-License-Identifier: AGPL-3.0-or-later
#include "oscillation.h"

#include "tetradapt/compare/tet_quadrature.h"
#include "tetradapt/mechanics/supports.h"

#include <deal.II/base/numbers.h>

#include <algorithm>
#include <cmath>

namespace tetradapt::estimate
{
  double
  load_oscillation(const CellState             &state,
                   const double                 largest_compliance,
                   const std::array<double, 4> &faces)
  {
    if (state.force_oscillation == 0. && *std::max_element(faces.begin(), faces.end()) == 0.)
      return 0.;
    // The rows of the inverse of the map from the regular tetrahedron with corners
    // (1,1,1), (1,-1,-1), (-1,1,-1), (-1,-1,1) over sqrt(8): the regular one's
    // position is the sum of its corners times the barycentric coordinates.
    const double s             = 1. / std::sqrt(8.);
    const double corners[4][3] = {{s, s, s}, {s, -s, -s}, {-s, s, -s}, {-s, -s, s}};
    Tensor<2, 3> inverse;
    for (unsigned int v = 0; v < 4; ++v)
      for (unsigned int i = 0; i < 3; ++i)
        for (unsigned int j = 0; j < 3; ++j)
          inverse[i][j] += corners[v][i] * state.gradients[v][j];
    const auto   squares = eigenvalues(symmetrize(inverse * transpose(inverse)));
    const double largest = 1. / std::sqrt(squares[2]), smallest = 1. / std::sqrt(squares[0]);
    const double common = largest * largest / smallest;
    // Volume of the regular one over that of the cell.
    const double determinant = std::sqrt(2.) / 12. / state.volume;
    double       sum         = .215 * common * state.force_oscillation;
    for (unsigned int f = 0; f < 4; ++f)
      {
        const double area = 3. * state.volume * state.gradients[f].norm();
        sum += common * std::sqrt(area / (std::sqrt(3.) / 4.) * determinant) * faces[f];
      }
    return std::sqrt(largest_compliance) * sum;
  }

  namespace
  {
    constexpr unsigned int none = dealii::numbers::invalid_unsigned_int;

    /** Coefficients of what is added to u_h: 4 l_a l_b (degree 1) or l_a l_b (l_a -
     * l_b) (degree 2) on edges from a to b, 27 l_0 l_1 l_2 on listed faces. */
    struct Lifting
    {
      std::vector<Tensor<1, 3>> edges, faces;
      std::vector<char>         on_edge, on_face;
      bool                      any = false;
    };

    class SupportLifting
    {
    public:
      SupportLifting(const mesh::NodalField                         &u_h,
                     const mesh::EdgeTable                          &edges,
                     const std::vector<std::array<unsigned int, 6>> &face_nodes,
                     Lifting                                        &result)
        : u_h(u_h), mesh(u_h.mesh()), edges(edges), face_nodes(face_nodes), result(result)
      {
        result.edges.resize(edges.edges.size());
        result.on_edge.assign(edges.edges.size(), 0);
        if (u_h.degree() == 2)
          {
            result.faces.resize(mesh.faces.size());
            result.on_face.assign(mesh.faces.size(), 0);
          }
        for (const auto &u : u_h.values)
          for (unsigned int c = 0; c < 3; ++c)
            largest = std::max(largest, std::abs(u[c]));
      }

      void
      add(const scene::SupportParameters &support, const core::VectorExpression &displacement)
      {
        for (unsigned int f = 0; f < mesh.faces.size(); ++f)
          {
            const auto &selections = mesh.patches[mesh.faces[f].patch].selections;
            if (std::find(selections.begin(), selections.end(), "Supports/" + support.name)
                == selections.end())
              continue;
            for (unsigned int s = 0; s < 3; ++s)
              {
                const unsigned int edge = face_nodes[f][3 + s] - mesh.n_points();
                if (result.on_edge[edge] == 0)
                  set(support,
                      edge_term(edge, displacement),
                      result.edges[edge],
                      result.on_edge[edge]);
              }
            if (u_h.degree() == 2)
              set(support, face_term(f, displacement), result.faces[f], result.on_face[f]);
          }
      }

    private:
      void
      set(const scene::SupportParameters &support,
          const Tensor<1, 3>             &value,
          Tensor<1, 3>                   &term,
          char                           &is_set)
      {
        for (unsigned int c = 0; c < 3; ++c)
          // Rounding is no difference.
          if (support.components[c] && std::abs(value[c]) > 1e-12 * largest)
            {
              term[c]    = value[c];
              is_set     = 1;
              result.any = true;
            }
      }

      Tensor<1, 3>
      edge_term(const unsigned int edge, const core::VectorExpression &displacement) const
      {
        const unsigned int a = edges.edges[edge][0], b = edges.edges[edge][1];
        const auto        &values = u_h.values;
        const auto         at     = [&](const double t) {
          return Point<3>(mesh.points[a] + t * (mesh.points[b] - mesh.points[a]));
        };
        if (u_h.degree() == 1)
          return displacement(at(.5)) - .5 * (values[a] + values[b]);
        // The odd part of the difference at the quarters, where the function is 3/32.
        const Tensor<1, 3> own = .5 * (values[a] - values[b]);
        return (16. / 3.) * (displacement(at(.25)) - displacement(at(.75)) - own);
      }

      Tensor<1, 3>
      face_term(const unsigned int face, const core::VectorExpression &displacement) const
      {
        Point<3>     center;
        Tensor<1, 3> own;
        for (unsigned int s = 0; s < 3; ++s)
          {
            center += Tensor<1, 3>(mesh.points[face_nodes[face][s]]) / 3.;
            own
              += (4. * u_h.values[face_nodes[face][3 + s]] - u_h.values[face_nodes[face][s]]) / 9.;
          }
        return displacement(center) - own;
      }

      const mesh::NodalField                         &u_h;
      const mesh::TetMesh                            &mesh;
      const mesh::EdgeTable                          &edges;
      const std::vector<std::array<unsigned int, 6>> &face_nodes;
      Lifting                                        &result;
      double                                          largest = 0.;
    };

    /** Square of the energy norm of the lifting in one cell. */
    double
    cell_energy(const mesh::NodalField &u_h,
                const mesh::EdgeTable  &edges,
                const CellFaces        &faces,
                const Lifting          &lifting,
                const laws::LinearLaw  &law,
                const unsigned int      cell)
    {
      const mesh::TetMesh          &mesh = u_h.mesh();
      const auto                    g    = mesh::barycentric_gradients(mesh, cell);
      const compare::TetQuadrature &rule = compare::tet_quadrature(5);
      double                        sum  = 0.;
      for (unsigned int q = 0; q < rule.points.size(); ++q)
        {
          const auto  &b = rule.points[q];
          Tensor<2, 3> G;
          for (unsigned int e = 0; e < 6; ++e)
            {
              const unsigned int edge = edges.cell_edges[cell][e];
              if (lifting.on_edge[edge] == 0)
                continue;
              unsigned int i = mesh::edge_vertices[e][0], k = mesh::edge_vertices[e][1];
              if (mesh.cells[cell][i] != edges.edges[edge][0])
                std::swap(i, k);
              const Tensor<1, 3> derivative
                = u_h.degree() == 1
                    ? 4. * (b[k] * g[i] + b[i] * g[k])
                    : b[k] * (2. * b[i] - b[k]) * g[i] + b[i] * (b[i] - 2. * b[k]) * g[k];
              G += outer_product(lifting.edges[edge], derivative);
            }
          for (unsigned int f = 0; f < 4 && u_h.degree() == 2; ++f)
            {
              const unsigned int which = faces.boundary[faces.sides[cell][f].face];
              if (which == none || lifting.on_face[which] == 0)
                continue;
              const auto        &v = mesh::face_vertices[f];
              const Tensor<1, 3> derivative
                = 27.
                  * (b[v[1]] * b[v[2]] * g[v[0]] + b[v[2]] * b[v[0]] * g[v[1]]
                     + b[v[0]] * b[v[1]] * g[v[2]]);
              G += outer_product(lifting.faces[which], derivative);
            }
          sum += rule.weights[q] * law.energy_density(symmetrize(G));
        }
      return sum * mesh::cell_volume(mesh, cell);
    }
  } // namespace

  double
  support_oscillation(const mesh::NodalField       &u_h,
                      const mesh::EdgeTable        &edges,
                      const CellFaces              &faces,
                      const scene::Scene           &scene,
                      const mechanics::MaterialMap &materials)
  {
    const mesh::TetMesh                     &mesh = u_h.mesh();
    Lifting                                  lifting;
    std::vector<std::array<unsigned int, 6>> face_nodes;
    std::unique_ptr<SupportLifting>          supports;
    for (const auto &support : scene.supports)
      {
        const core::VectorExpression displacement(support.displacement,
                                                  "Supports/" + support.name + "/Displacement");
        if (displacement.is_constant())
          continue;
        if (supports == nullptr)
          {
            face_nodes = mechanics::boundary_face_nodes(mesh, &edges);
            supports   = std::make_unique<SupportLifting>(u_h, edges, face_nodes, lifting);
          }
        supports->add(support, displacement);
      }
    double sum = 0.;
    if (lifting.any)
      for (unsigned int cell = 0; cell < mesh.n_cells(); ++cell)
        {
          bool touched = false;
          for (const unsigned int edge : edges.cell_edges[cell])
            touched = touched || lifting.on_edge[edge] != 0;
          // A face without a term on its edges is possible, if rare.
          for (unsigned int f = 0; f < 4 && u_h.degree() == 2; ++f)
            {
              const unsigned int which = faces.boundary[faces.sides[cell][f].face];
              touched                  = touched || (which != none && lifting.on_face[which] != 0);
            }
          if (touched)
            sum += cell_energy(
              u_h, edges, faces, lifting, materials.linear_law(mesh.regions[cell]), cell);
        }
    return std::sqrt(sum);
  }
} // namespace tetradapt::estimate
