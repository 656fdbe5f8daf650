// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/supports.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/core/expression.h"
#include "tetradapt/mechanics/point_conditions.h"
#include "tetradapt/mechanics/rigid_motions.h"
#include "tetradapt/mesh/finalize.h"

#include <deal.II/lac/affine_constraints.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>

namespace tetradapt::mechanics
{
  namespace
  {
    using dealii::Point;
    using dealii::Tensor;

    Point<3>
    position(const mesh::TetMesh &mesh, const mesh::EdgeTable *edges, unsigned int node)
    {
      if (node < mesh.n_points())
        return mesh.points[node];
      const auto &edge = edges->edges[node - mesh.n_points()];
      return mesh.points[edge[0]] + 0.5 * (mesh.points[edge[1]] - mesh.points[edge[0]]);
    }

    /** Prescribes one component of one node, or throws if another support has
     * prescribed another value. */
    class Prescriber
    {
    public:
      Prescriber(const std::vector<scene::SupportParameters> &supports,
                 const mesh::TetMesh                         &mesh,
                 const mesh::EdgeTable                       *edges,
                 PrescribedDisplacement                      &result)
        : supports(supports), mesh(mesh), edges(edges), result(result), owners(result.fixed.size())
      {
      }

      /** Returns the number of the pair in PrescribedDisplacement::held_nodes. */
      unsigned int
      add_node(unsigned int support, unsigned int node, const core::VectorExpression &displacement)
      {
        result.held_nodes.push_back({node, support, supports[support].components, 0.});
        const Point<3>     x     = position(mesh, edges, node);
        const Tensor<1, 3> value = displacement(x);
        for (unsigned int c = 0; c < 3; ++c)
          if (supports[support].components[c])
            {
              if (result.is_fixed(node, c))
                check_agreement(support, node, c, x, value);
              result.fixed[node] |= 1u << c;
              result.values[node][c] = value[c];
              owners[node][c]        = support;
            }
        return result.held_nodes.size() - 1;
      }

    private:
      void
      check_agreement(unsigned int        support,
                      unsigned int        node,
                      unsigned int        c,
                      const Point<3>     &x,
                      const Tensor<1, 3> &value) const
      {
        const double before = result.values[node][c];
        const double size   = std::max(std::abs(before), std::abs(value[c]));
        if (std::abs(before - value[c]) <= 1e-9 * size)
          return;
        std::ostringstream message;
        message << "Supports/" << supports[owners[node][c]].name << " and Supports/"
                << supports[support].name << " contradict each other at " << mesh::to_string(x)
                << ": displacement component "
                << "xyz"[c] << " is " << before << " by the one and " << value[c]
                << " by the other. Leave the component out of one of them, or let their faces not "
                   "touch.";
        throw core::InputError(message.str());
      }

      const std::vector<scene::SupportParameters> &supports;
      const mesh::TetMesh                         &mesh;
      const mesh::EdgeTable                       *edges;
      PrescribedDisplacement                      &result;
      std::vector<std::array<unsigned int, 3>>     owners;
    };
  } // namespace

  bool
  PrescribedDisplacement::is_homogeneous() const
  {
    return std::all_of(values.begin(), values.end(), [](const auto &v) { return v == 0. * v; });
  }

  fem::Constraints
  make_constraints(const PrescribedDisplacement &prescribed, const fem::Space &space)
  {
    fem::Constraints constraints = fem::make_constraints(space);
    for (unsigned int node = 0; node < space.n_local_nodes(); ++node)
      {
        const unsigned int field_node = space.field_node(node);
        for (unsigned int c = 0; c < 3; ++c)
          if (prescribed.is_fixed(field_node, c))
            {
              const auto unknown = space.vector_layout()->local_to_global(3 * node + c);
              constraints.add_line(unknown);
              constraints.set_inhomogeneity(unknown, prescribed.values[field_node][c]);
            }
      }
    constraints.close();
    return constraints;
  }

  std::vector<std::array<unsigned int, 6>>
  boundary_face_nodes(const mesh::TetMesh &mesh, const mesh::EdgeTable *edges)
  {
    std::vector<std::array<unsigned int, 6>> nodes(mesh.faces.size());
    std::unique_ptr<mesh::EdgeFinder>        finder;
    if (edges != nullptr)
      finder = std::make_unique<mesh::EdgeFinder>(*edges, mesh.n_points());
    for (unsigned int f = 0; f < mesh.faces.size(); ++f)
      for (unsigned int i = 0; i < 3; ++i)
        {
          const auto &v = mesh.faces[f].vertices;
          nodes[f][i]   = v[i];
          nodes[f][3 + i]
            = finder == nullptr ? v[i] : mesh.n_points() + finder->find(v[i], v[(i + 1) % 3]);
        }
    return nodes;
  }

  PrescribedDisplacement
  prescribe(const std::vector<scene::SupportParameters> &supports,
            const mesh::TetMesh                         &mesh,
            const mesh::EdgeTable                       *edges)
  {
    const unsigned int     n_nodes = mesh.n_points() + (edges == nullptr ? 0 : edges->edges.size());
    PrescribedDisplacement result;
    result.fixed.assign(n_nodes, 0);
    result.values.resize(n_nodes);

    const auto   face_nodes = boundary_face_nodes(mesh, edges);
    Prescriber   prescriber(supports, mesh, edges, result);
    unsigned int n_per_face = edges == nullptr ? 3 : 6;
    for (unsigned int s = 0; s < supports.size(); ++s)
      {
        const core::VectorExpression displacement(supports[s].displacement,
                                                  "Supports/" + supports[s].name + "/Displacement");
        if (supports[s].place.is_set())
          {
            for (const unsigned int node : held_place_nodes(supports[s], mesh, edges))
              prescriber.add_node(s, node, displacement);
            continue;
          }
        std::vector<unsigned int> held(n_nodes, dealii::numbers::invalid_unsigned_int);
        for (unsigned int f = 0; f < mesh.faces.size(); ++f)
          {
            const auto &selections = mesh.patches[mesh.faces[f].patch].selections;
            if (std::find(selections.begin(), selections.end(), "Supports/" + supports[s].name)
                == selections.end())
              continue;
            const double area = mesh::face_area_vector(mesh, mesh.faces[f]).norm();
            for (unsigned int i = 0; i < n_per_face; ++i)
              {
                const unsigned int node = face_nodes[f][i];
                if (held[node] == dealii::numbers::invalid_unsigned_int)
                  held[node] = prescriber.add_node(s, node, displacement);
                result.held_nodes[held[node]].area += area;
              }
          }
      }
    check_rigid_motions(mesh, result);
    return result;
  }
} // namespace tetradapt::mechanics
