// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/flat_nodes.h"

#include <deal.II/base/symmetric_tensor.h>

#include <algorithm>
#include <cmath>

namespace tetradapt::solve
{
  namespace
  {
    /** Of 27 det M / (tr M)^3: bricks about three times longer than thick, and those that are
     * not flat, but more so than cubes. */
    constexpr double largest_isotropy = 0.15, rather_flat = 0.3;
    /** The mean below which cells are very flat: bricks about eight times longer. */
    constexpr double very_flat = 0.025;
    /** The mean below which cells are clearly flat: bricks about 4.5 times longer. */
    constexpr double clearly_flat = 0.075;
    /** Of the longest edge, in flat and in very flat cells. Columns of bricks are half an edge
     * apart. */
    constexpr double reach_by_edge = 0.2, reach_if_very_flat = 0.16;
    /** Nodes of a cluster, about: its inverse is a dense matrix. */
    constexpr std::size_t largest_cluster = 30;
    /** Around flat cells: others among them would hold the clusters like supports. */
    constexpr unsigned int rings = 3;
    /** Of all points, that have to be flat to be worth the effort; and that have to be rather
     * flat for all to be taken. */
    constexpr double least_share = 0.002, share_of_all = 0.5;
    /** Of all points, from which flat ones decide how the whole mesh is smoothed. */
    constexpr double dominant_share = 0.5;

    /** What the cells around a vertex look like. */
    struct Shape
    {
      dealii::SymmetricTensor<2, 3> tensor;
      double                        longest = 0.; ///< square of the longest edge

      void
      add(const Shape &other)
      {
        tensor += other.tensor;
        longest = std::max(longest, other.longest);
      }
      /** 27 det M / (tr M)^3. */
      double
      isotropy() const
      {
        const double size = trace(tensor);
        return 27. * determinant(tensor) / (size * size * size);
      }
    };

    Shape
    shape_of(const mesh::TetMesh &mesh, const unsigned int cell)
    {
      Shape       shape;
      const auto &corners = mesh.cells[cell];
      for (unsigned int i = 0; i < 4; ++i)
        for (unsigned int j = 0; j < i; ++j)
          {
            const auto edge = mesh.points[corners[i]] - mesh.points[corners[j]];
            for (unsigned int a = 0; a < 3; ++a)
              for (unsigned int b = 0; b <= a; ++b)
                shape.tensor[a][b] += edge[a] * edge[b];
            shape.longest = std::max(shape.longest, edge.norm_square());
          }
      return shape;
    }
    /** Adds the vertices of all cells that touch one of the @p points. */
    void
    dilate(const fem::Space &space, std::vector<unsigned char> &points)
    {
      const auto before = points;
      for (const unsigned int cell : space.touching_cells())
        {
          const auto &corners = space.tet_mesh().cells[cell];
          if (std::any_of(corners.begin(), corners.end(), [&](auto p) { return before[p] != 0; }))
            for (const unsigned int point : corners)
              points[point] = 1;
        }
    }
    void
    sum(std::array<double, 4> &values, MPI_Comm communicator)
    {
      MPI_Allreduce(MPI_IN_PLACE, values.data(), 4, MPI_DOUBLE, MPI_SUM, communicator);
    }
  } // namespace

  FlatNodes
  find_flat_nodes(const fem::Space &space)
  {
    const mesh::TetMesh &mesh     = space.tet_mesh();
    const unsigned int   n_points = mesh.n_points();
    std::vector<Shape>   shapes(n_points);
    for (const unsigned int cell : space.touching_cells())
      {
        const Shape shape = shape_of(mesh, cell);
        for (const unsigned int point : mesh.cells[cell])
          shapes[point].add(shape);
      }
    // On several ranks, points next to others' cells count more than once: these are shares.
    std::vector<unsigned char> is_flat(n_points, 0);
    std::array<double, 4>      sums{}; // points, flat ones, their isotropy, rather flat ones
    for (unsigned int point = 0; point < n_points; ++point)
      if (shapes[point].longest > 0.)
        {
          const double isotropy = shapes[point].isotropy();
          sums[0] += 1.;
          sums[3] += isotropy < rather_flat ? 1. : 0.;
          if (isotropy < largest_isotropy)
            {
              is_flat[point] = 1;
              sums[1] += 1.;
              sums[2] += std::max(isotropy, 0.);
            }
        }
    FlatNodes flat;
    sum(sums, space.communicator());
    if (sums[1] < least_share * sums[0])
      return flat;
    flat.are_very_flat = sums[2] < very_flat * sums[1];
    flat.are_dominant  = sums[1] > dominant_share * sums[0] && sums[2] < clearly_flat * sums[1];
    if (sums[3] < share_of_all * sums[0])
      for (unsigned int k = 0; k < rings; ++k)
        dilate(space, is_flat);
    else
      is_flat.assign(n_points, 1);

    const double part  = flat.are_very_flat ? reach_if_very_flat : reach_by_edge;
    const auto  *edges = space.edge_table();
    flat.reach.assign(space.n_owned_nodes(), 0.);
    for (unsigned int node = 0; node < flat.reach.size(); ++node)
      {
        const unsigned int          field_node = space.field_node(node);
        std::array<unsigned int, 2> ends{{field_node, field_node}};
        if (field_node >= n_points)
          for (unsigned int i = 0; i < 2; ++i)
            ends[i] = edges->edges[field_node - n_points][i];
        if (is_flat[ends[0]] != 0 && is_flat[ends[1]] != 0)
          flat.reach[node]
            = part * std::sqrt(std::max(shapes[ends[0]].longest, shapes[ends[1]].longest));
      }
    flat.exist = true;
    return flat;
  }

  Aggregates
  cluster(const FlatNodes &flat, const fem::Space &space, const BlockRows<3, 3> &matrix)
  {
    const unsigned int            n_nodes = flat.reach.size();
    std::vector<dealii::Point<3>> positions(n_nodes);
    for (unsigned int node = 0; node < n_nodes; ++node)
      if (flat.reach[node] > 0.)
        positions[node] = space.node_position(node);
    Aggregates clusters;
    clusters.of_node.assign(n_nodes, no_aggregate);
    std::vector<unsigned int> members;
    for (unsigned int seed = 0; seed < n_nodes; ++seed)
      {
        if (!(flat.reach[seed] > 0.) || clusters.of_node[seed] != no_aggregate)
          continue;
        members.assign(1, seed);
        clusters.of_node[seed] = clusters.count;
        for (std::size_t next = 0; next < members.size() && members.size() < largest_cluster;
             ++next)
          for (std::size_t k = matrix.begin[members[next]]; k < matrix.begin[members[next] + 1];
               ++k)
            {
              const unsigned int node = matrix.columns[k];
              if (node < n_nodes && flat.reach[node] > 0. && clusters.of_node[node] == no_aggregate
                  && positions[node].distance(positions[seed]) <= flat.reach[seed])
                {
                  clusters.of_node[node] = clusters.count;
                  members.push_back(node);
                }
            }
        ++clusters.count;
      }
    return clusters;
  }
} // namespace tetradapt::solve
