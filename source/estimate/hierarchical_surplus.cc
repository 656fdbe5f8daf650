// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/hierarchical_surplus.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/core/expression.h"
#include "tetradapt/mechanics/point_conditions.h"
#include "tetradapt/mechanics/sliding_normals.h"
#include "tetradapt/mesh/face_table.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace tetradapt::estimate
{
  namespace
  {
    constexpr double odd_scale  = HierarchicalSurplus::odd_scale;
    constexpr double face_scale = HierarchicalSurplus::face_scale;

    /** Local edges of the local faces, opposite the face's vertices in turn: edge k of a
     * face joins its vertices k and k + 1. */
    std::array<unsigned int, 3>
    edges_of_face(unsigned int face)
    {
      std::array<unsigned int, 3> result{};
      for (unsigned int k = 0; k < 3; ++k)
        {
          const unsigned int a = mesh::face_vertices[face][k];
          const unsigned int b = mesh::face_vertices[face][(k + 1) % 3];
          for (unsigned int e = 0; e < 6; ++e)
            if (std::minmax(a, b)
                == std::minmax(mesh::edge_vertices[e][0], mesh::edge_vertices[e][1]))
              result[k] = e;
        }
      return result;
    }

    /** Coefficients of one support's displacement. */
    class SurplusOf
    {
    public:
      SurplusOf(const scene::SupportParameters &support, const HierarchicalSurplus &surplus)
        : displacement(support.displacement, "Supports/" + support.name + "/Displacement"),
          surplus(surplus), points(surplus.mesh().points), linear(displacement.is_constant())
      {
      }

      Tensor<1, 3>
      of_edge(unsigned int edge) const
      {
        if (linear)
          return {};
        const auto        &ends = surplus.edges().edges[edge]; // smaller number first
        const Point<3>    &a = points[ends[0]], &b = points[ends[1]];
        const Tensor<1, 3> difference = displacement(a) - displacement(b);
        if (surplus.degree() == 1)
          return displacement(a + 0.5 * (b - a)) - displacement(b) - 0.5 * difference;
        const Tensor<1, 3> inner = displacement(a + (b - a) / 3.) - displacement(b + (a - b) / 3.);
        return 0.5 * (inner - difference / 3.) / (odd_scale * 2. / 27.);
      }

      Tensor<1, 3>
      of_face(const std::array<unsigned int, 3> &v) const
      {
        if (linear)
          return {};
        Tensor<1, 3> interpolated;
        Point<3>     centre;
        for (unsigned int k = 0; k < 3; ++k)
          {
            const Point<3> &a = points[v[k]], &b = points[v[(k + 1) % 3]];
            interpolated += 4. / 9. * displacement(a + 0.5 * (b - a)) - displacement(a) / 9.;
            centre += (a - Point<3>()) / 3.;
          }
        return displacement(centre) - interpolated;
      }

    private:
      const core::VectorExpression displacement;
      const HierarchicalSurplus   &surplus;
      const std::vector<Point<3>> &points;
      bool                         linear; ///< constant, at least
    };
  } // namespace

  FaceNumbers
  number_faces(const mesh::TetMesh &mesh)
  {
    FaceNumbers        result;
    const unsigned int n_slots = 4 * mesh.n_cells();
    result.cell_faces.resize(mesh.n_cells());
    result.boundary_slots.resize(mesh.faces.size());
    mesh::FaceTable(mesh).for_each_triangle(
      [&](const mesh::FaceTable::Entry *first, const mesh::FaceTable::Entry *last) {
        for (const auto *entry = first; entry != last; ++entry)
          if (entry->slot < n_slots)
            result.cell_faces[entry->slot / 4][entry->slot % 4] = result.n_faces;
          else
            result.boundary_slots[entry->slot - n_slots] = first->slot;
        ++result.n_faces;
      });
    return result;
  }

  HierarchicalSurplus::HierarchicalSurplus(const mesh::NodalField &field)
    : mesh_pointer(field.shared_mesh()),
      edge_pointer(field.degree() == 2
                     ? field.shared_edges()
                     : std::make_shared<const mesh::EdgeTable>(mesh::build_edges(field.mesh()))),
      face_numbers(number_faces(field.mesh())), polynomial_degree(field.degree())
  {
  }

  void
  HierarchicalSurplus::values(unsigned int degree, const mesh::Barycentric &b, double *values)
  {
    for (unsigned int e = 0; e < 6; ++e)
      {
        const double first = b[mesh::edge_vertices[e][0]], second = b[mesh::edge_vertices[e][1]];
        values[e]
          = degree == 1 ? 4. * first * second : odd_scale * first * second * (first - second);
      }
    if (degree == 2)
      for (unsigned int f = 0; f < 4; ++f)
        {
          const auto &v = mesh::face_vertices[f];
          values[6 + f] = face_scale * b[v[0]] * b[v[1]] * b[v[2]];
        }
  }

  void
  HierarchicalSurplus::gradients(unsigned int                       degree,
                                 const mesh::Barycentric           &b,
                                 const std::array<Tensor<1, 3>, 4> &directions,
                                 Tensor<1, 3>                      *gradients)
  {
    for (unsigned int e = 0; e < 6; ++e)
      {
        const unsigned int i = mesh::edge_vertices[e][0], j = mesh::edge_vertices[e][1];
        if (degree == 1)
          gradients[e] = 4. * (b[j] * directions[i] + b[i] * directions[j]);
        else
          gradients[e] = odd_scale
                         * (b[j] * (2. * b[i] - b[j]) * directions[i]
                            + b[i] * (b[i] - 2. * b[j]) * directions[j]);
      }
    if (degree == 2)
      for (unsigned int f = 0; f < 4; ++f)
        {
          const auto &v = mesh::face_vertices[f];
          gradients[6 + f]
            = face_scale
              * (b[v[1]] * b[v[2]] * directions[v[0]] + b[v[0]] * b[v[2]] * directions[v[1]]
                 + b[v[0]] * b[v[1]] * directions[v[2]]);
        }
  }

  namespace
  {
    /** Prescribes the surplus along the normals of sliding faces. */
    void
    hold_sliding(const std::vector<scene::SupportParameters> &supports,
                 const HierarchicalSurplus                   &surplus,
                 const scene::MeshParameters                 &surface,
                 mechanics::PrescribedDisplacement           &result)
    {
      const mesh::TetMesh            &mesh = surplus.mesh();
      const mechanics::SlidingNormals normals(supports, mesh, surface);
      if (normals.empty())
        return;
      std::vector<SurplusOf> distances; // first component
      for (scene::SupportParameters support : supports)
        {
          support.displacement = {{support.normal_displacement, "0", "0"}};
          distances.emplace_back(support, surplus);
        }
      const auto hold = [&](const unsigned int               function,
                            const Point<3>                  &place,
                            const std::vector<unsigned int> &faces,
                            const auto                      &coefficient) {
        mechanics::HeldDirections held = result.directions_at(function);
        for (const auto &direction : normals.at(place, faces))
          for (const unsigned int s : direction.supports)
            held.add(direction.normal, coefficient(distances[s])[0], s);
        result.hold(function, held);
      };
      std::map<unsigned int, std::vector<unsigned int>> faces_at; // of edges
      for (const unsigned int f : normals.faces())
        {
          const unsigned int cell  = surplus.faces().boundary_slots[f] / 4;
          const unsigned int local = surplus.faces().boundary_slots[f] % 4;
          for (const unsigned int e : edges_of_face(local))
            faces_at[surplus.function(cell, e)].push_back(f);
          if (surplus.degree() == 2)
            {
              const auto &v = mesh.faces[f].vertices;
              Point<3>    centre;
              for (const unsigned int vertex : v)
                centre += (mesh.points[vertex] - Point<3>()) / 3.;
              hold(surplus.function(cell, 6 + local), centre, {f}, [&](const SurplusOf &distance) {
                return distance.of_face(v);
              });
            }
        }
      for (const auto &[edge, faces] : faces_at)
        {
          const unsigned int number = edge;
          const auto        &ends   = surplus.edges().edges[edge];
          const Point<3>     middle
            = mesh.points[ends[0]] + 0.5 * (mesh.points[ends[1]] - mesh.points[ends[0]]);
          hold(number, middle, faces, [&](const SurplusOf &distance) {
            return distance.of_edge(number);
          });
        }
    }
  } // namespace

  mechanics::PrescribedDisplacement
  prescribe_surplus(const std::vector<scene::SupportParameters> &supports,
                    const HierarchicalSurplus                   &surplus,
                    const scene::MeshParameters                 &surface)
  {
    const mesh::TetMesh              &mesh = surplus.mesh();
    mechanics::PrescribedDisplacement result;
    result.fixed.assign(surplus.n_functions(), 0);
    result.values.resize(surplus.n_functions());
    for (const auto &support : supports)
      {
        const std::string selection = "Supports/" + support.name;
        if (support.type == scene::SupportType::rigid)
          throw core::InputError(selection
                                 + " couples its faces rigidly, for which there is no solution of "
                                   "the next degree. Choose another estimator.");
        if (support.type != scene::SupportType::fixed)
          continue;
        const SurplusOf coefficients(support, surplus);
        unsigned char   components = 0;
        for (unsigned int c = 0; c < 3; ++c)
          components |= static_cast<unsigned char>(support.components[c]) << c;
        const auto set = [&](unsigned int function, const Tensor<1, 3> &value) {
          result.fixed[function] |= components;
          for (unsigned int c = 0; c < 3; ++c)
            if (support.components[c])
              result.values[function][c] = value[c];
        };
        // Vertices have no function; the edges of a line do.
        if (support.place.line)
          {
            const auto nodes = mechanics::held_place_nodes(support, mesh, &surplus.edges());
            for (const unsigned int node : nodes)
              if (node >= mesh.n_points())
                set(node - mesh.n_points(), coefficients.of_edge(node - mesh.n_points()));
          }
        for (unsigned int f = 0; f < mesh.faces.size(); ++f)
          {
            const auto &selections = mesh.patches[mesh.faces[f].patch].selections;
            if (std::find(selections.begin(), selections.end(), selection) == selections.end())
              continue;
            const unsigned int cell  = surplus.faces().boundary_slots[f] / 4;
            const unsigned int local = surplus.faces().boundary_slots[f] % 4;
            for (const unsigned int e : edges_of_face(local))
              set(surplus.function(cell, e), coefficients.of_edge(surplus.function(cell, e)));
            if (surplus.degree() == 2)
              set(surplus.function(cell, 6 + local), coefficients.of_face(mesh.faces[f].vertices));
          }
      }
    hold_sliding(supports, surplus, surface, result);
    return result;
  }
} // namespace tetradapt::estimate
