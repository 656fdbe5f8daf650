// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/reactions.h"

#include "stiffness_points.h"

#include <deal.II/base/mpi.h>

#include <algorithm>
#include <cmath>

namespace tetradapt::mechanics
{
  namespace
  {
    using dealii::Point;

    /** Adds up what the cells at supports do to the nodes there. */
    class SupportedCells
    {
    public:
      SupportedCells(const MaterialMap            &materials,
                     const PrescribedDisplacement &prescribed,
                     const fem::Field             &displacement,
                     const bool                    with_layer_energy)
        : space(displacement.space()), materials(materials), prescribed(prescribed),
          displacement(displacement), with_layer_energy(with_layer_energy),
          points(stiffness_points(space.degree())), forces(space.n_owned_nodes())
      {
        for (unsigned int k = 0; k < space.touching_cells().size(); ++k)
          if (is_supported(space.touching_cells()[k]))
            add(k);
      }

      const fem::Space              &space;
      const MaterialMap             &materials;
      const PrescribedDisplacement  &prescribed;
      const fem::Field              &displacement;
      bool                           with_layer_energy;
      std::vector<mesh::Barycentric> points;
      std::vector<Tensor<1, 3>>      forces; ///< of the stress, right at owned nodes that are held
      std::array<double, 3>          layer_energy{};

    private:
      /** Supports hold the ends of an edge whose middle they hold. */
      bool
      is_supported(const unsigned int cell) const
      {
        const auto &vertices = space.tet_mesh().cells[cell];
        return std::any_of(vertices.begin(), vertices.end(), [&](const unsigned int v) {
          return prescribed.fixed[v] != 0;
        });
      }

      /** The k-th of the cells that touch owned nodes. */
      void
      add(const unsigned int k)
      {
        const unsigned int           cell             = space.touching_cells()[k];
        const unsigned int          *nodes            = space.local_nodes_of(k);
        const mesh::TetMesh         &mesh             = space.tet_mesh();
        const unsigned int           n_nodes          = space.n_nodes_per_cell();
        const auto                   lambda_gradients = mesh::barycentric_gradients(mesh, cell);
        const double                 weight = mesh::cell_volume(mesh, cell) / points.size();
        const bool                   counts = with_layer_energy && space.is_own_cell(k);
        std::array<Tensor<1, 3>, 10> gradients, values;
        displacement.values_of_cell(k, values);
        for (const mesh::Barycentric &point : points)
          {
            mesh::shape_gradients(space.degree(), point, lambda_gradients, gradients.data());
            Tensor<2, 3> G;
            for (unsigned int i = 0; i < n_nodes; ++i)
              G += outer_product(values[i], gradients[i]);
            const SymmetricTensor<2, 3> stress = stress_at(cell, point, G);
            for (unsigned int i = 0; i < n_nodes; ++i)
              {
                if (nodes[i] < space.n_owned_nodes()
                    && prescribed.fixed[space.field_node(nodes[i])] != 0)
                  forces[nodes[i]] += weight * (stress * gradients[i]);
              }
            if (counts)
              add_layer_energy(cell, gradients, weight);
          }
      }

      /** One less where free is one where prescribed, with the sign changed: a rigid motion
       * has no energy. */
      void
      add_layer_energy(const unsigned int                  cell,
                       const std::array<Tensor<1, 3>, 10> &gradients,
                       const double                        weight)
      {
        for (unsigned int c = 0; c < 3; ++c)
          {
            Tensor<2, 3> G;
            for (unsigned int i = 0; i < space.n_nodes_per_cell(); ++i)
              if (prescribed.fixed[space.cell_node(cell, i)] != 0)
                G += outer_product(held_part(space.cell_node(cell, i), c), gradients[i]);
            const SymmetricTensor<2, 3> strain = symmetrize(G);
            const int                   region = space.tet_mesh().regions[cell];
            layer_energy[c]
              += weight
                 * (displacement.pressure() ? materials.pressure_form(region).stress(G, 0.) * strain
                                            : materials.linear_law(region).energy_density(strain));
          }
      }

      /** What supports hold at a node of a translation by one along @p c. */
      Tensor<1, 3>
      held_part(const unsigned int node, const unsigned int c) const
      {
        Tensor<1, 3> axis;
        axis[c] = 1.;
        if (prescribed.fixed[node] != PrescribedDisplacement::is_coupled)
          return axis - prescribed.free_part(node, axis);
        const auto coupling = std::find_if(
          prescribed.rigid.begin(), prescribed.rigid.end(), [&](const RigidCoupling &candidate) {
            return std::binary_search(candidate.nodes.begin(), candidate.nodes.end(), node);
          });
        return coupling->prescribed[c] ? axis : Tensor<1, 3>();
      }

      SymmetricTensor<2, 3>
      stress_at(const unsigned int       cell,
                const mesh::Barycentric &point,
                const Tensor<2, 3>      &G) const
      {
        const int region = space.tet_mesh().regions[cell];
        return displacement.pressure() ? materials.pressure_form(region).stress(
                 G, displacement.pressure()->value(cell, point))
                                       : materials.linear_law(region).stress(G);
      }
    };

    Tensor<1, 3>
    at_node(const fem::Vector &vector, const unsigned int node)
    {
      Tensor<1, 3> value;
      for (unsigned int c = 0; c < 3; ++c)
        value[c] = vector.local_element(3 * node + c);
      return value;
    }

    /** What the supports among @p begin to @p end take of the reaction at a node that slides: each
     * along its own directions, the sum of the squares by their areas as small as possible. */
    std::vector<Tensor<1, 3>>
    shares(const std::vector<HeldNode>::const_iterator &begin,
           const std::vector<HeldNode>::const_iterator &end,
           const Tensor<1, 3>                          &reaction)
    {
      std::vector<SymmetricTensor<2, 3>> parts;
      SymmetricTensor<2, 3>              sum;
      for (auto held = begin; held != end; ++held)
        {
          SymmetricTensor<2, 3> part = held->normals;
          for (unsigned int c = 0; c < 3; ++c)
            if (held->components[c])
              part[c][c] += 1.;
          parts.push_back((held->area > 0. ? held->area : 1.) * part);
          sum += parts.back();
        }
      // x solves sum x = reaction in the directions that are held at all.
      Tensor<1, 3> x;
      double       largest = 0.;
      const auto   pairs
        = dealii::eigenvectors(sum, dealii::SymmetricTensorEigenvectorMethod::jacobi);
      for (const auto &[value, vector] : pairs)
        largest = std::max(largest, value);
      for (const auto &[value, vector] : pairs)
        if (value > 1e-12 * largest)
          x += (vector * reaction) / value * vector;
      std::vector<Tensor<1, 3>> result;
      for (const auto &part : parts)
        result.push_back(part * x);
      return result;
    }

    bool
    slides(const HeldNode &held)
    {
      return trace(held.normals) > 0.;
    }

    /** The weight with which a support counts at a node among @p begin to @p end that prescribe
     * component @p c there; all sum to one. */
    double
    share(const HeldNode                              &held,
          const std::vector<HeldNode>::const_iterator &begin,
          const std::vector<HeldNode>::const_iterator &end,
          const unsigned int                           c)
    {
      unsigned int n    = 0;
      double       area = 0.;
      for (auto other = begin; other != end; ++other)
        if (other->components[c])
          {
            ++n;
            area += other->area;
          }
      return n == 1 ? 1. : area > 0. ? held.area / area : 1. / n;
    }
  } // namespace

  Reactions
  compute_reactions(const MaterialMap            &materials,
                    const PrescribedDisplacement &prescribed,
                    const fem::Vector            &forces,
                    const fem::Vector            *internal_forces,
                    const fem::Field             &displacement,
                    const unsigned int            n_supports,
                    const bool                    with_layer_energy)
  {
    const fem::Space                     &space = displacement.space();
    std::unique_ptr<const SupportedCells> cells;
    if (internal_forces == nullptr)
      cells = std::make_unique<const SupportedCells>(materials,
                                                     prescribed,
                                                     displacement,
                                                     with_layer_energy);
    std::vector<HeldNode> held;
    std::copy_if(prescribed.held_nodes.begin(),
                 prescribed.held_nodes.end(),
                 std::back_inserter(held),
                 [&](const HeldNode &h) {
                   return space.local_node(h.node) < space.n_owned_nodes();
                 });
    std::stable_sort(held.begin(), held.end(), [](const HeldNode &a, const HeldNode &b) {
      return a.node < b.node;
    });

    Reactions result;
    result.supports.resize(n_supports);
    result.n_nodes.resize(n_supports, 0);
    for (const HeldNode &h : prescribed.held_nodes) // the same on every rank
      ++result.n_nodes[h.support];
    for (auto begin = held.cbegin(); begin != held.cend();)
      {
        const unsigned int node = begin->node, local = space.local_node(node);
        const auto         end
          = std::find_if(begin, held.cend(), [&](const HeldNode &h) { return h.node != node; });
        Tensor<1, 3> reaction = (cells ? cells->forces[local] : at_node(*internal_forces, local))
                                - at_node(forces, local);
        if (prescribed.fixed[node] != PrescribedDisplacement::is_coupled)
          reaction -= prescribed.free_part(node, reaction);
        result.magnitude += reaction.norm();
        Point<3> x = space.node_position(local);
        if (internal_forces != nullptr)
          x += displacement.value(local);
        if (std::any_of(begin, end, slides))
          {
            const auto parts = shares(begin, end, reaction);
            for (auto h = begin; h != end; ++h)
              result.supports[h->support].add(x, parts[h - begin]);
            begin = end;
            continue;
          }
        for (auto h = begin; h != end; ++h)
          {
            Tensor<1, 3> part;
            for (unsigned int c = 0; c < 3; ++c)
              if (h->components[c])
                part[c] = share(*h, begin, end, c) * reaction[c];
            result.supports[h->support].add(x, part);
          }
        begin = end;
      }
    for (Resultant &support : result.supports)
      support = sum(support, space.communicator());
    result.magnitude = dealii::Utilities::MPI::sum(result.magnitude, space.communicator());
    for (unsigned int c = 0; cells && c < 3; ++c)
      result.layer_energy[c]
        = dealii::Utilities::MPI::sum(cells->layer_energy[c], space.communicator());
    return result;
  }
} // namespace tetradapt::mechanics
