// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/hexahedral_indicators.h"

#include "tetradapt/mesh/hexahedral_field.h"

#include <deal.II/base/quadrature_lib.h>

#include <cmath>
#include <set>

namespace tetradapt::solve
{
  namespace
  {
    using mechanics::SymmetricTensor;
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
      const auto        &law = materials.law(region);
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

    /** Counts at each node, for each axis, the cells' sides there that are normal to it
     * and on which neither loads nor supports act. Collective. */
    Vector
    count_free_sides(const HexahedralForest &forest, const HexahedralSpace &space)
    {
      const HexahedralGrid &grid = forest.grid();
      const unsigned int    n    = space.degree + 1;
      Vector                free(space.layout);
      for (unsigned int c = 0; c < forest.cells().size(); ++c)
        for (unsigned int side = 0; side < 6; ++side)
          {
            const HexahedralCell &cell = forest.cells()[c];
            if ((cell.outer >> side & 1) == 0
                || !grid.patches[grid.sides[cell.brick][side]].selections.empty())
              continue;
            const unsigned int stride[3] = {1, n, n * n}, axis = side / 2;
            for (unsigned int i = 0; i < n * n * n; ++i)
              if (i / stride[axis] % n == (side % 2 == 1 ? n - 1 : 0)
                  && space.nodes(c)[i] < space.n_local)
                free.local_element(3 * space.nodes(c)[i] + axis) += 1.;
          }
      free.compress(dealii::VectorOperation::add);
      return free;
    }

    /** Means of stresses at the nodes, of the cells of one region. On free sides the
     * stress on the side is zero. */
    class MeanStress
    {
    public:
      MeanStress(const HexahedralSpace &space, const Vector &free_sides)
        : space(space), free_sides(free_sides), normal(space.layout), shear(space.layout),
          count(space.layout)
      {
      }

      void
      add(const unsigned int node, const Stress &stress)
      {
        if (node >= space.n_local)
          return;
        for (unsigned int c = 0; c < 3; ++c)
          {
            normal.local_element(3 * node + c) += stress[c][c];
            shear.local_element(3 * node + c) += stress[c][(c + 1) % 3];
          }
        count.local_element(3 * node) += 1.;
      }

      void
      finish()
      {
        for (Vector *vector : {&normal, &shear, &count})
          vector->compress(dealii::VectorOperation::add);
        for (unsigned int node = 0; node < space.n_owned; ++node)
          if (count.local_element(3 * node) > 1.)
            for (unsigned int c = 0; c < 3; ++c)
              {
                normal.local_element(3 * node + c) /= count.local_element(3 * node);
                shear.local_element(3 * node + c) /= count.local_element(3 * node);
              }
        for (unsigned int node = 0; node < space.n_owned; ++node)
          for (unsigned int c = 0; c < 3; ++c)
            if (free_sides.local_element(3 * node + c) != 0.)
              {
                normal.local_element(3 * node + c)          = 0.;
                shear.local_element(3 * node + c)           = 0.;
                shear.local_element(3 * node + (c + 2) % 3) = 0.;
              }
        normal.update_ghost_values();
        shear.update_ghost_values();
      }

      Stress
      at(const unsigned int node) const
      {
        const Tensor<1, 3> on_diagonal = space.value(normal, node), off = space.value(shear, node);
        Stress             result;
        for (unsigned int c = 0; c < 3; ++c)
          {
            result[c][c]           = on_diagonal[c];
            result[c][(c + 1) % 3] = off[c];
          }
        return result;
      }

    private:
      const HexahedralSpace &space;
      const Vector          &free_sides;
      Vector                 normal, shear, count;
    };
  } // namespace

  std::vector<double>
  hexahedral_indicators(const HexahedralForest       &forest,
                        const HexahedralSpace        &space,
                        const mechanics::MaterialMap &materials,
                        const Vector                 &displacement)
  {
    const HexahedralGrid     &grid = forest.grid();
    const Edge                edge(space.degree);
    const unsigned int        n = edge.n;
    std::vector<double>       result(forest.cells().size(), 0.);
    std::vector<Tensor<1, 3>> u(space.nodes_per_cell);
    std::vector<Stress>       stresses(space.nodes_per_cell);
    const auto                compute = [&](const unsigned int c) {
      for (unsigned int i = 0; i < space.nodes_per_cell; ++i)
        u[i] = space.value(displacement, space.nodes(c)[i]);
      const HexahedralCell &cell = forest.cells()[c];
      nodal_stresses(edge, cell, grid.regions[cell.brick], materials, u, stresses);
    };
    const Vector free_sides = count_free_sides(forest, space);
    displacement.update_ghost_values();
    std::set<int> regions;
    for (unsigned int brick = 0; brick < grid.n_bricks(); ++brick)
      if (grid.filled[brick])
        regions.insert(grid.regions[brick]);
    for (const int region : regions)
      {
        const auto &law = materials.law(region);
        MeanStress  mean(space, free_sides);
        for (unsigned int c = 0; c < result.size(); ++c)
          if (grid.regions[forest.cells()[c].brick] == region)
            {
              compute(c);
              for (unsigned int i = 0; i < space.nodes_per_cell; ++i)
                mean.add(space.nodes(c)[i], stresses[i]);
            }
        mean.finish();
        for (unsigned int c = 0; c < result.size(); ++c)
          if (grid.regions[forest.cells()[c].brick] == region)
            {
              compute(c);
              for (unsigned int i = 0; i < space.nodes_per_cell; ++i)
                stresses[i] -= mean.at(space.nodes(c)[i]);
              to_gauss_points(edge, stresses);
              const Tensor<1, 3> &size = forest.cells()[c].size;
              for (unsigned int q = 0; q < space.nodes_per_cell; ++q)
                result[c] += size[0] * size[1] * size[2] * edge.gauss.weight(q % n)
                             * edge.gauss.weight(q / n % n) * edge.gauss.weight(q / n / n)
                             * law.complementary_density(stresses[q]);
              result[c] = std::sqrt(std::max(result[c], 0.));
            }
      }
    displacement.zero_out_ghost_values();
    return result;
  }
} // namespace tetradapt::solve
