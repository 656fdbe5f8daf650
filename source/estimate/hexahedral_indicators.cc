// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/hexahedral_indicators.h"

#include "tetradapt/mesh/hexahedral_field.h"

#include <deal.II/base/quadrature_lib.h>

#include <cmath>
#include <set>

namespace tetradapt::estimate
{
  namespace
  {
    using dealii::Tensor;
    using mechanics::SymmetricTensor;
    using solve::Constraints;
    using solve::HexahedralCell;
    using solve::HexahedralGrid;
    using solve::HexahedralSpace;
    using solve::Vector;
    using Stress = SymmetricTensor<2, 3>;

    /** Functions along an edge: derivatives at the nodes, values at Gauss' points. */
    struct Edge
    {
      explicit Edge(const unsigned int degree)
        : n(degree + 1), gauss(n), nodes(mesh::hexahedral_nodes(degree))
      {
        double unused[4];
        for (unsigned int q = 0; q < n; ++q)
          {
            mesh::lagrange(degree, nodes[q], unused, slope[q]);
            mesh::lagrange(degree, gauss.point(q)[0], value[q], unused);
          }
      }
      unsigned int        n;
      dealii::QGauss<1>   gauss;
      std::vector<double> nodes;
      double              slope[4][4]; ///< at a node, of a function
      double              value[4][4];
    };

    /** Stresses at the nodes of a cell, without what thermal strain takes. */
    void
    nodal_stresses(const Edge                      &edge,
                   const HexahedralCell            &cell,
                   const int                        region,
                   const mechanics::MaterialMap    &materials,
                   const std::vector<Tensor<1, 3>> &displacement,
                   std::vector<Stress>             &stresses)
    {
      const auto        &law = materials.linear_law(region);
      const unsigned int n = edge.n, stride[3] = {1, n, n * n};
      for (unsigned int node = 0; node < n * n * n; ++node)
        {
          const unsigned int at[3] = {node % n, node / n % n, node / n / n};
          Tensor<2, 3>       G;
          for (unsigned int d = 0; d < 3; ++d)
            for (unsigned int k = 0; k < n; ++k)
              {
                const Tensor<1, 3> &u      = displacement[node + (k - at[d]) * stride[d]];
                const double        factor = edge.slope[at[d]][k] / cell.size[d];
                for (unsigned int c = 0; c < 3; ++c)
                  G[c][d] += factor * u[c];
              }
          if (materials.has_thermal_strain())
            G -= Tensor<2, 3>(materials.thermal_strain(
              region, cell.at({edge.nodes[at[0]], edge.nodes[at[1]], edge.nodes[at[2]]})));
          stresses[node] = law.stress(G);
        }
    }

    /** Interpolates values at the nodes to Gauss' points, one direction after the
     * other. */
    void
    to_gauss_points(const Edge &edge, std::vector<Stress> &values)
    {
      const unsigned int n = edge.n;
      Stress             line[4];
      unsigned int       stride = 1;
      for (unsigned int d = 0; d < 3; ++d, stride *= n)
        for (unsigned int outer = 0; outer < n * n * n; outer += n * stride)
          for (unsigned int inner = outer; inner < outer + stride; ++inner)
            {
              for (unsigned int q = 0; q < n; ++q)
                {
                  line[q] = Stress();
                  for (unsigned int k = 0; k < n; ++k)
                    line[q] += edge.value[q][k] * values[inner + k * stride];
                }
              for (unsigned int q = 0; q < n; ++q)
                values[inner + q * stride] = line[q];
            }
    }

    /** Counts at each node the cells' sides that make a stress vanish there, those on which
     * neither loads nor supports act. */
    struct FreeSides
    {
      FreeSides(const HexahedralSpace &space, const Vector &like) : normal(like), shear(like)
      {
        normal                     = 0.;
        shear                      = 0.;
        const HexahedralGrid &grid = space.forest().grid();
        const unsigned int    n    = space.degree() + 1;
        HexahedralSpace::Dofs dofs;
        for (unsigned int c = 0; c < space.forest().cells().size(); ++c)
          for (unsigned int side = 0; side < 6; ++side)
            {
              const unsigned int patch = space.forest().cells()[c].patches[side];
              if (patch == HexahedralGrid::none || !grid.patches[patch].selections.empty())
                continue;
              space.get_dofs(c, dofs);
              const unsigned int stride[3] = {1, n, n * n}, axis = side / 2;
              for (unsigned int i = 0; i < n * n * n; ++i)
                if (i / stride[axis] % n == (side % 2 == 1 ? n - 1 : 0)
                    && !space.hanging_nodes().is_constrained(dofs[3 * i]))
                  {
                    normal(dofs[3 * i + axis]) += 1.;
                    shear(dofs[3 * i + axis]) += 1.;
                    shear(dofs[3 * i + (axis + 2) % 3]) += 1.;
                  }
            }
        normal.compress(dealii::VectorOperation::add);
        shear.compress(dealii::VectorOperation::add);
      }

      Vector normal; ///< entry c of a node: of component cc
      Vector shear;  ///< of component c, c + 1
    };

    /** Means of stresses at the nodes, of the cells of one region. On free sides the
     * stress on the side is zero. */
    class MeanStress
    {
    public:
      MeanStress(const Constraints &hanging_nodes, const FreeSides &free_sides)
        : hanging_nodes(hanging_nodes), free_sides(free_sides), normal(free_sides.normal),
          shear(normal), count(normal)
      {
        for (Vector *vector : {&normal, &shear, &count})
          *vector = 0.;
      }

      /** @param dofs of a node. */
      void
      add(const dealii::types::global_dof_index *dofs, const Stress &stress)
      {
        if (hanging_nodes.is_constrained(dofs[0]))
          return;
        for (unsigned int c = 0; c < 3; ++c)
          {
            normal(dofs[c]) += stress[c][c];
            shear(dofs[c]) += stress[c][(c + 1) % 3];
            count(dofs[c]) += 1.;
          }
      }

      void
      finish()
      {
        for (Vector *vector : {&normal, &shear, &count})
          vector->compress(dealii::VectorOperation::add);
        for (unsigned int i = 0; i < count.locally_owned_size(); ++i)
          {
            const double share = 1. / std::max(1., count.local_element(i));
            normal.local_element(i) *= free_sides.normal.local_element(i) != 0. ? 0. : share;
            shear.local_element(i) *= free_sides.shear.local_element(i) != 0. ? 0. : share;
          }
        for (Vector *vector : {&normal, &shear})
          {
            hanging_nodes.distribute(*vector);
            vector->update_ghost_values();
          }
      }

      Stress
      at(const dealii::types::global_dof_index *dofs) const
      {
        Stress result;
        for (unsigned int c = 0; c < 3; ++c)
          {
            result[c][c]           = normal(dofs[c]);
            result[c][(c + 1) % 3] = shear(dofs[c]);
          }
        return result;
      }

    private:
      const Constraints &hanging_nodes;
      const FreeSides   &free_sides;
      Vector             normal, shear, count;
    };
  } // namespace

  std::vector<double>
  hexahedral_indicators(const HexahedralSpace        &space,
                        const mechanics::MaterialMap &materials,
                        const Vector                 &displacement)
  {
    const auto               &cells   = space.forest().cells();
    const unsigned int        n_nodes = space.nodes_per_cell();
    const Edge                edge(space.degree());
    const unsigned int        n = edge.n;
    std::vector<double>       result(cells.size(), 0.);
    HexahedralSpace::Dofs     dofs;
    std::vector<Tensor<1, 3>> u(n_nodes);
    std::vector<Stress>       stresses(n_nodes);
    const auto                compute = [&](const unsigned int c) {
      space.get_dofs(c, dofs);
      for (unsigned int i = 0; i < dofs.size(); ++i)
        u[i / 3][i % 3] = displacement(dofs[i]);
      nodal_stresses(edge, cells[c], cells[c].region, materials, u, stresses);
    };
    const FreeSides free_sides(space, displacement);
    displacement.update_ghost_values();
    const HexahedralGrid &grid = space.forest().grid();
    std::set<int>         regions;
    for (unsigned int brick = 0; brick < grid.n_bricks(); ++brick)
      if (grid.filled[brick])
        regions.insert(grid.regions[brick]);
    for (const int region : regions)
      {
        const auto &law = materials.linear_law(region);
        MeanStress  mean(space.hanging_nodes(), free_sides);
        for (unsigned int c = 0; c < result.size(); ++c)
          if (cells[c].region == region)
            {
              compute(c);
              for (unsigned int i = 0; i < n_nodes; ++i)
                mean.add(&dofs[3 * i], stresses[i]);
            }
        mean.finish();
        for (unsigned int c = 0; c < result.size(); ++c)
          if (cells[c].region == region)
            {
              compute(c);
              for (unsigned int i = 0; i < n_nodes; ++i)
                stresses[i] -= mean.at(&dofs[3 * i]);
              to_gauss_points(edge, stresses);
              const Tensor<1, 3> &size = cells[c].size;
              for (unsigned int q = 0; q < n_nodes; ++q)
                result[c] += size[0] * size[1] * size[2] * edge.gauss.weight(q % n)
                             * edge.gauss.weight(q / n % n) * edge.gauss.weight(q / n / n)
                             * law.complementary_density(stresses[q]);
              result[c] = std::sqrt(std::max(result[c], 0.));
            }
      }
    displacement.zero_out_ghost_values();
    return result;
  }
} // namespace tetradapt::estimate
