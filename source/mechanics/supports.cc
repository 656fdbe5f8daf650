// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/supports.h"

#include "tetradapt/core/exceptions.h"
#include "tetradapt/core/expression.h"
#include "tetradapt/mechanics/point_conditions.h"
#include "tetradapt/mechanics/rigid_motions.h"
#include "tetradapt/mechanics/sliding_normals.h"
#include "tetradapt/mesh/finalize.h"

#include <deal.II/lac/affine_constraints.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <sstream>
#include <tuple>

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
        result.held_nodes.push_back({node, support, supports[support].components, 0., {}});
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

    /** Prescribes the displacement along the normals of sliding supports, on top of the
     * components that others prescribe. */
    class Slider
    {
    public:
      Slider(const std::vector<scene::SupportParameters> &supports,
             const mesh::TetMesh                         &mesh,
             const mesh::EdgeTable                       *edges,
             const scene::MeshParameters                 &surface,
             PrescribedDisplacement                      &result)
        : supports(supports), mesh(mesh), edges(edges), normals(supports, mesh, surface),
          result(result)
      {
        for (const auto &support : supports)
          distances.emplace_back(support.normal_displacement,
                                 "Supports/" + support.name + "/Normal displacement");
      }

      void
      hold(const std::vector<std::array<unsigned int, 6>> &face_nodes)
      {
        if (normals.empty())
          return;
        for (const HeldNode &held : result.held_nodes)
          for (unsigned int c = 0; c < 3; ++c)
            if (held.components[c])
              owners[held.node][c] = held.support;
        const unsigned int                                n_per_face = edges == nullptr ? 3 : 6;
        std::map<unsigned int, std::vector<unsigned int>> faces_at; // of field nodes
        for (const unsigned int f : normals.faces())
          for (unsigned int i = 0; i < n_per_face; ++i)
            faces_at[face_nodes[f][i]].push_back(f);
        for (const auto &[node, faces] : faces_at)
          hold_node(node, faces);
      }

    private:
      void
      hold_node(const unsigned int node, const std::vector<unsigned int> &faces)
      {
        const Point<3>                         x   = position(mesh, edges, node);
        HeldDirections                         all = result.directions_at(node, owners[node]);
        std::map<unsigned int, HeldDirections> own; // of each support
        double                                 spread = 0.;
        for (const auto &direction : normals.at(x, faces))
          for (const unsigned int s : direction.supports)
            {
              spread             = std::max(spread, direction.spread);
              const double value = distances[s](x);
              if (const auto conflict = all.add(direction.normal, value, s))
                refuse(x, direction.normal, s, value, *conflict, direction.spread);
              own[s].add(direction.normal, 0., s);
            }
        for (const auto &[s, directions] : own)
          {
            double area = 0.;
            for (const unsigned int f : faces)
              if (const auto on_face = normals.supports_of(f);
                  std::count(on_face.begin(), on_face.end(), s) > 0)
                area += mesh::face_area_vector(mesh, mesh.faces[f]).norm();
            result.held_nodes.push_back(
              {node, s, {{false, false, false}}, area, directions.projector()});
          }
        result.hold(node, all);
        if (spread > 1e-6)
          result.uncertainty[node] = spread;
      }

      [[noreturn]] void
      refuse(const Point<3>                 &x,
             const Tensor<1, 3>             &normal,
             const unsigned int              support,
             const double                    value,
             const HeldDirections::Conflict &conflict,
             const double                    spread) const
      {
        std::ostringstream message;
        message.precision(4);
        const std::string &name = supports[support].name, &other = supports[conflict.owner].name;
        if (other == name)
          message << "Supports/" << name << " contradicts itself";
        else
          message << "Supports/" << other << " and Supports/" << name
                  << (conflict.sine > 0. ? " hold the body" : " contradict each other");
        if (conflict.sine > 0.)
          {
            message << " at " << mesh::to_string(x) << " in directions that differ by "
                    << std::asin(conflict.sine) * 180. / dealii::numbers::PI
                    << " degrees only, which together would clamp it: along the normal ("
                    << normal[0] << ", " << normal[1] << ", " << normal[2]
                    << ") and nearly along that. Hold the faces by one of them, or let their faces "
                       "not touch.";
            throw core::InputError(message.str());
          }
        message << " at " << mesh::to_string(x) << ": the displacement along (" << normal[0] << ", "
                << normal[1] << ", " << normal[2] << ") is " << conflict.value << " by "
                << (other == name ? "other faces" : "the one") << " and " << value << " by "
                << (other == name ? "these" : "the other")
                << ". Give both the same displacement there, or let their faces not touch"
                << (spread > 1e-6 ? ". The normal is a mean of faces that meet at less than "
                                    "Mesh/Feature angle; a smaller angle keeps them apart."
                                  : ".");
        throw core::InputError(message.str());
      }

      const std::vector<scene::SupportParameters> &supports;
      const mesh::TetMesh                         &mesh;
      const mesh::EdgeTable                       *edges;
      SlidingNormals                               normals;
      PrescribedDisplacement                      &result;
      std::vector<core::Expression>                distances; ///< a support each
      /** Who fixes the components of nodes. */
      std::map<unsigned int, std::array<unsigned int, 3>> owners;
    };

    /** Distance of a reference point from its faces, compared with their size: the condition of the
     * six motions grows with its square. */
    constexpr double farthest_reference = 1e4;

    /** The nodes of a support's faces, ascending, and the faces' centroid. */
    std::pair<std::vector<unsigned int>, Point<3>>
    nodes_of(const std::string                              &selection,
             const mesh::TetMesh                            &mesh,
             const std::vector<std::array<unsigned int, 6>> &face_nodes,
             const unsigned int                              n_per_face)
    {
      std::vector<unsigned int> nodes;
      double                    area = 0.;
      Tensor<1, 3>              sum;
      for (unsigned int f = 0; f < mesh.faces.size(); ++f)
        {
          const auto &selections = mesh.patches[mesh.faces[f].patch].selections;
          if (std::count(selections.begin(), selections.end(), selection) == 0)
            continue;
          nodes.insert(nodes.end(), face_nodes[f].begin(), face_nodes[f].begin() + n_per_face);
          const double size = mesh::face_area_vector(mesh, mesh.faces[f]).norm();
          area += size;
          for (const unsigned int v : mesh.faces[f].vertices)
            sum += size / 3. * mesh.points[v];
        }
      std::sort(nodes.begin(), nodes.end());
      nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
      return {nodes, area > 0. ? Point<3>(sum / area) : Point<3>()};
    }

    void
    couple(const std::vector<scene::SupportParameters>    &supports,
           const unsigned int                              s,
           const mesh::TetMesh                            &mesh,
           const mesh::EdgeTable                          *edges,
           const std::vector<std::array<unsigned int, 6>> &face_nodes,
           PrescribedDisplacement                         &result)
    {
      const std::string selection = "Supports/" + supports[s].name;
      const auto       &rigid     = supports[s].rigid;
      RigidCoupling     coupling;
      Point<3>          centroid;
      std::tie(coupling.nodes, centroid)
        = nodes_of(selection, mesh, face_nodes, edges == nullptr ? 3 : 6);
      coupling.support   = s;
      coupling.reference = rigid.reference_point.value_or(centroid);
      for (unsigned int k = 0; k < 6; ++k)
        {
          const auto &component  = k < 3 ? rigid.translation[k] : rigid.rotation[k - 3];
          coupling.prescribed[k] = component.has_value();
          coupling.values[k]     = component.value_or(0.);
        }
      for (const unsigned int node : coupling.nodes)
        coupling.positions.push_back(position(mesh, edges, node));
      double size = 0.;
      for (const Point<3> &x : coupling.positions)
        size = std::max(size, x.distance(centroid));
      if (!(coupling.reference.distance(centroid) <= farthest_reference * size))
        throw core::InputError(
          selection + "/Reference point: " + mesh::to_string(coupling.reference)
          + " is more than 10 000 times as far from the faces as these are large: "
            "rounding would spoil rotations and moments. Choose a nearer one.");
      coupling.make_basis();

      for (std::size_t i = 0; i < coupling.nodes.size(); ++i)
        {
          const unsigned int node = coupling.nodes[i];
          if (result.fixed[node] != 0)
            {
              const auto other
                = std::find_if(result.held_nodes.begin(),
                               result.held_nodes.end(),
                               [&](const HeldNode &held) { return held.node == node; });
              throw core::InputError(
                selection + " couples its faces rigidly, and shares the point "
                + mesh::to_string(coupling.positions[i]) + " with Supports/"
                + supports[other->support].name
                + ", which holds it also. Let their faces not touch, or prescribe Translation and "
                  "Rotation in the place of the other support.");
            }
          result.fixed[node] = coupling.basis.empty() ? 7 : PrescribedDisplacement::is_coupled;
          result.values[node]
            = displacement(coupling.values, coupling.positions[i] - coupling.reference);
          result.held_nodes.push_back({node, s, {{true, true, true}}, 0., {}});
        }
      result.rigid.push_back(std::move(coupling));
    }

    /** Adds the lines of a node that is held in the directions of @p held: one with its largest
     * component, or two that depend on the largest component of what is free. */
    void
    add_inclined(const SymmetricTensor<2, 3>          &held,
                 const Tensor<1, 3>                   &value,
                 const dealii::types::global_dof_index first,
                 fem::Constraints                     &constraints)
    {
      const auto largest = [](const Tensor<1, 3> &v) {
        unsigned int k = 0;
        for (unsigned int c = 1; c < 3; ++c)
          if (std::abs(v[c]) > std::abs(v[k]))
            k = c;
        return k;
      };
      // The column of a projector on one direction that is largest is along it.
      const auto direction = [](const Tensor<2, 3> &projector) {
        Tensor<1, 3> best;
        for (unsigned int c = 0; c < 3; ++c)
          if (projector[c].norm_square() > best.norm_square())
            best = projector[c];
        return best / best.norm();
      };
      const auto add = [&](const unsigned int of, const unsigned int on, const double factor) {
        if (factor != 0.)
          constraints.add_entry(first + of, first + on, factor);
      };
      if (trace(held) < 1.5)
        {
          const Tensor<1, 3> n = direction(held);
          const unsigned int k = largest(n);
          constraints.add_line(first + k);
          for (unsigned int j = 0; j < 3; ++j)
            if (j != k)
              add(k, j, -n[j] / n[k]);
          constraints.set_inhomogeneity(first + k, (n * value) / n[k]);
          return;
        }
      const Tensor<1, 3> t = direction(dealii::unit_symmetric_tensor<3>() - held);
      const unsigned int m = largest(t);
      for (unsigned int k = 0; k < 3; ++k)
        if (k != m)
          {
            constraints.add_line(first + k);
            add(k, m, t[k] / t[m]);
            constraints.set_inhomogeneity(first + k, value[k] - t[k] / t[m] * value[m]);
          }
    }
  } // namespace

  HeldDirections
  PrescribedDisplacement::directions_at(const unsigned int                 node,
                                        const std::array<unsigned int, 3> &owners) const
  {
    HeldDirections directions;
    for (unsigned int c = 0; c < 3; ++c)
      if (is_fixed(node, c))
        {
          Tensor<1, 3> axis;
          axis[c] = 1.;
          directions.add(axis, values[node][c], owners[c]);
        }
    return directions;
  }

  void
  PrescribedDisplacement::hold(const unsigned int node, const HeldDirections &directions)
  {
    values[node] = directions.value();
    inclined.erase(node);
    if (const auto components = directions.components())
      {
        fixed[node] = *components;
        for (unsigned int c = 0; c < 3; ++c)
          if (!is_fixed(node, c))
            values[node][c] = 0.;
      }
    else
      {
        fixed[node]    = is_inclined;
        inclined[node] = directions.projector();
      }
  }

  Tensor<1, 3>
  PrescribedDisplacement::free_part(const unsigned int node, const Tensor<1, 3> &vector) const
  {
    if (fixed[node] == is_inclined)
      return vector - inclined.at(node) * vector;
    Tensor<1, 3> result = vector;
    for (unsigned int c = 0; c < 3; ++c)
      if (is_fixed(node, c))
        result[c] = 0.;
    return result;
  }

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
        if (prescribed.fixed[field_node] == PrescribedDisplacement::is_inclined)
          add_inclined(prescribed.inclined.at(field_node),
                       prescribed.values[field_node],
                       space.vector_layout()->local_to_global(3 * node),
                       constraints);
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
            const mesh::EdgeTable                       *edges,
            const scene::MeshParameters                 &surface)
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
        if (supports[s].type != scene::SupportType::fixed)
          continue;
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
    Slider(supports, mesh, edges, surface, result).hold(face_nodes);
    for (unsigned int s = 0; s < supports.size(); ++s)
      if (supports[s].type == scene::SupportType::rigid)
        couple(supports, s, mesh, edges, face_nodes, result);
    // With springs it takes those to see.
    if (std::none_of(supports.begin(), supports.end(), [](const auto &support) {
          return support.type == scene::SupportType::spring;
        }))
      check_rigid_motions(mesh, result);
    return result;
  }

  std::pair<Tensor<1, 3>, Tensor<1, 3>>
  reference_forces(const scene::SupportParameters &support)
  {
    const std::string path = "Supports/" + support.name;
    return {core::VectorExpression(support.rigid.force, path + "/Force")(Point<3>()),
            core::VectorExpression(support.rigid.moment, path + "/Moment")(Point<3>())};
  }

  void
  add_rigid_forces(const std::vector<scene::SupportParameters> &supports,
                   const PrescribedDisplacement                &prescribed,
                   const fem::Space                            &space,
                   fem::Vector                                 &forces)
  {
    for (const RigidCoupling &coupling : prescribed.rigid)
      {
        const auto [force, moment] = reference_forces(supports[coupling.support]);
        if (force.norm_square() == 0. && moment.norm_square() == 0.)
          continue;
        const auto nodal = coupling.nodal_forces(force, moment);
        for (std::size_t i = 0; i < nodal.size(); ++i)
          if (const unsigned int node = space.local_node(coupling.nodes[i]);
              node < space.n_owned_nodes())
            for (unsigned int c = 0; c < 3; ++c)
              forces.local_element(3 * node + c) += nodal[i][c];
      }
  }
} // namespace tetradapt::mechanics
