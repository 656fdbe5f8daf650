// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mesh/hexahedral_field.h"

#include "tetradapt/core/exceptions.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetradapt::mesh
{
  namespace
  {
    [[noreturn]] void
    refuse(const std::string &what)
    {
      throw core::NumericalError("A field on hexahedra does not fit together: " + what + '.');
    }

    /** Number of the interval of @p planes that holds @p x, or the nearest one. */
    unsigned int
    interval(const std::vector<double> &planes, const double x)
    {
      const auto above = std::upper_bound(planes.begin() + 1, planes.end() - 1, x);
      return above - planes.begin() - 1;
    }
  } // namespace

  std::vector<double>
  hexahedral_nodes(const unsigned int degree)
  {
    if (degree == 1)
      return {0., 1.};
    if (degree == 2)
      return {0., .5, 1.};
    const double inner = .5 - .5 / std::sqrt(5.);
    return {0., inner, 1. - inner, 1.};
  }

  void
  lagrange(const unsigned int degree, const double x, double *values, double *derivatives)
  {
    if (degree == 1)
      {
        values[0]      = 1. - x;
        values[1]      = x;
        derivatives[0] = -1.;
        derivatives[1] = 1.;
        return;
      }
    if (degree == 2)
      {
        values[0]      = (1. - x) * (1. - 2. * x);
        values[1]      = 4. * x * (1. - x);
        values[2]      = x * (2. * x - 1.);
        derivatives[0] = 4. * x - 3.;
        derivatives[1] = 4. - 8. * x;
        derivatives[2] = 4. * x - 1.;
        return;
      }
    // Nodes 0, a, b, 1 with b = 1 - a, ab = 1/5, b - a = 1/sqrt(5).
    static const double root = std::sqrt(5.);
    static const double a = .5 - .5 / root, b = .5 + .5 / root;
    const double        y = x - 1., p = x - a, q = x - b;
    values[0]      = -5. * p * q * y;
    values[3]      = 5. * x * p * q;
    derivatives[0] = -5. * (q * y + p * y + p * q);
    derivatives[3] = 5. * (p * q + x * q + x * p);
    values[1]      = 5. * root * x * q * y;
    values[2]      = -5. * root * x * p * y;
    derivatives[1] = 5. * root * (q * y + x * y + x * q);
    derivatives[2] = -5. * root * (p * y + x * y + x * p);
  }

  HexahedralField::HexahedralField(const unsigned int                 degree,
                                   std::array<std::vector<double>, 3> planes,
                                   std::vector<Cell>                  cells,
                                   std::vector<Tensor<1, 3>>          values)
    : polynomial_degree(degree), grid_planes(std::move(planes)), cell_list(std::move(cells)),
      nodal_values(std::move(values))
  {
    if (degree < 1 || degree > 3)
      refuse("its degree is " + std::to_string(degree));
    if (nodal_values.size() != cell_list.size() * nodes_per_cell())
      refuse("there are values at " + std::to_string(nodal_values.size()) + " nodes for "
             + std::to_string(cell_list.size()) + " cells");
    for (const auto &along : grid_planes)
      if (along.size() < 2 || !std::is_sorted(along.begin(), along.end()))
        refuse("its grid has no planes");
    build_trees();
  }

  std::array<Point<3>, 2>
  HexahedralField::brick_box(const unsigned int brick) const
  {
    const unsigned int      nx = grid_planes[0].size() - 1, ny = grid_planes[1].size() - 1;
    const unsigned int      i[3] = {brick % nx, brick / nx % ny, brick / nx / ny};
    std::array<Point<3>, 2> box;
    for (unsigned int d = 0; d < 3; ++d)
      {
        box[0][d] = grid_planes[d][i[d]];
        box[1][d] = grid_planes[d][i[d] + 1];
      }
    return box;
  }

  void
  HexahedralField::build_trees()
  {
    const std::size_t nx = grid_planes[0].size() - 1, ny = grid_planes[1].size() - 1,
                      nz = grid_planes[2].size() - 1;
    tree.assign(nx * ny * nz, TreeNode());
    std::vector<double> missing(tree.size(), 0.); // part of each touched brick without cells
    for (unsigned int c = 0; c < cell_list.size(); ++c)
      {
        const Cell    &cell   = cell_list[c];
        const Point<3> centre = cell.lower + .5 * cell.size;
        unsigned int   node
          = interval(grid_planes[0], centre[0])
            + nx * (interval(grid_planes[1], centre[1]) + ny * interval(grid_planes[2], centre[2]));
        const unsigned int brick = node;
        auto [lower, upper]      = brick_box(brick);
        const Tensor<1, 3> size  = upper - lower;
        for (unsigned int level = 0; cell.size[0] < .75 * (upper[0] - lower[0]); ++level)
          {
            if (level > 60 || tree[node].cell != none)
              refuse("cells overlap");
            if (tree[node].children == none)
              {
                tree[node].children = tree.size();
                tree.resize(tree.size() + 8);
              }
            unsigned int child = 0;
            for (unsigned int d = 0; d < 3; ++d)
              {
                const double middle           = lower[d] + .5 * (upper[d] - lower[d]);
                const bool   above            = centre[d] > middle;
                (above ? lower[d] : upper[d]) = middle;
                child |= static_cast<unsigned int>(above) << d;
              }
            node = tree[node].children + child;
          }
        if (tree[node].cell != none || tree[node].children != none)
          refuse("cells overlap");
        for (unsigned int d = 0; d < 3; ++d)
          if (!(std::abs(cell.lower[d] - lower[d]) < 1e-6 * cell.size[d]
                && std::abs(cell.size[d] - (upper[d] - lower[d])) < 1e-6 * cell.size[d]))
            refuse("a cell is not a part of a brick");
        tree[node].cell = c;
        missing[brick] += cell.size[0] / size[0] * cell.size[1] / size[1] * cell.size[2] / size[2];
      }
    for (unsigned int brick = 0; brick < missing.size(); ++brick)
      if (missing[brick] != 0. && std::abs(missing[brick] - 1.) > 1e-6)
        refuse("a part of a brick is missing");
  }

  HexahedralField::Location
  HexahedralField::locate_in_brick(const unsigned int brick, const Point<3> &point) const
  {
    // In the brick's coordinates, cut off at its border; then digit by digit.
    const auto [lower, upper] = brick_box(brick);
    Location     result;
    Point<3>     nearest;
    unsigned int node = brick;
    for (unsigned int d = 0; d < 3; ++d)
      {
        nearest[d]     = std::min(std::max(point[d], lower[d]), upper[d]);
        result.unit[d] = (nearest[d] - lower[d]) / (upper[d] - lower[d]);
      }
    while (tree[node].cell == none)
      {
        unsigned int child = 0;
        for (unsigned int d = 0; d < 3; ++d)
          {
            const bool above = result.unit[d] > .5;
            result.unit[d]   = 2. * result.unit[d] - above;
            child |= static_cast<unsigned int>(above) << d;
          }
        node = tree[node].children + child;
      }
    result.cell     = tree[node].cell;
    result.distance = point.distance(nearest);
    return result;
  }

  unsigned int
  HexahedralField::nearest_brick(const Point<3> &point) const
  {
    const unsigned int n_bricks
      = (grid_planes[0].size() - 1) * (grid_planes[1].size() - 1) * (grid_planes[2].size() - 1);
    unsigned int best    = none;
    double       nearest = std::numeric_limits<double>::max();
    for (unsigned int brick = 0; brick < n_bricks; ++brick)
      {
        if (tree[brick].cell == none && tree[brick].children == none)
          continue;
        const auto box     = brick_box(brick);
        double     squared = 0.;
        for (unsigned int d = 0; d < 3; ++d)
          squared += std::pow(std::max({box[0][d] - point[d], point[d] - box[1][d], 0.}), 2);
        if (squared < nearest)
          {
            nearest = squared;
            best    = brick;
          }
      }
    return best;
  }

  HexahedralField::Location
  HexahedralField::locate(const Point<3> &point) const
  {
    const std::size_t  nx = grid_planes[0].size() - 1, ny = grid_planes[1].size() - 1;
    const unsigned int brick
      = interval(grid_planes[0], point[0])
        + nx * (interval(grid_planes[1], point[1]) + ny * interval(grid_planes[2], point[2]));
    const bool empty = tree[brick].cell == none && tree[brick].children == none;
    return locate_in_brick(empty ? nearest_brick(point) : brick, point);
  }

  double
  HexahedralField::smallest_in(const unsigned int node,
                               const Point<3>    &node_lower,
                               const Point<3>    &node_upper,
                               const Point<3>    &lower,
                               const Point<3>    &upper,
                               const double       enough) const
  {
    if (tree[node].cell != none)
      return std::max({node_upper[0] - node_lower[0],
                       node_upper[1] - node_lower[1],
                       node_upper[2] - node_lower[2]});
    double smallest = std::numeric_limits<double>::infinity();
    if (tree[node].children == none)
      return smallest;
    const Point<3> middle = node_lower + .5 * (node_upper - node_lower);
    for (unsigned int child = 0; child < 8 && smallest > enough; ++child)
      {
        Point<3> child_lower = node_lower, child_upper = node_upper;
        bool     touches = true;
        for (unsigned int d = 0; d < 3; ++d)
          {
            ((child >> d & 1) != 0 ? child_lower[d] : child_upper[d]) = middle[d];
            touches = touches && child_lower[d] < upper[d] && lower[d] < child_upper[d];
          }
        if (touches)
          smallest = std::min(
            smallest,
            smallest_in(
              tree[node].children + child, child_lower, child_upper, lower, upper, enough));
      }
    return smallest;
  }

  double
  HexahedralField::smallest_size(const Point<3> &lower,
                                 const Point<3> &upper,
                                 const double    enough) const
  {
    unsigned int from[3], to[3];
    for (unsigned int d = 0; d < 3; ++d)
      {
        from[d] = interval(grid_planes[d], lower[d]);
        to[d]   = interval(grid_planes[d], upper[d]);
      }
    const unsigned int nx = grid_planes[0].size() - 1, ny = grid_planes[1].size() - 1;
    double             smallest = std::numeric_limits<double>::infinity();
    for (unsigned int k = from[2]; k <= to[2]; ++k)
      for (unsigned int j = from[1]; j <= to[1]; ++j)
        for (unsigned int i = from[0]; i <= to[0] && smallest > enough; ++i)
          {
            const unsigned int brick = i + nx * (j + ny * k);
            const auto         box   = brick_box(brick);
            smallest = std::min(smallest, smallest_in(brick, box[0], box[1], lower, upper, enough));
          }
    return smallest;
  }

  Tensor<1, 3>
  HexahedralField::value(const unsigned int cell, const Point<3> &unit) const
  {
    const unsigned int  n = polynomial_degree + 1;
    double              shape[3][4], unused[4];
    const Tensor<1, 3> *u = nodal_values.data() + std::size_t(cell) * nodes_per_cell();
    for (unsigned int d = 0; d < 3; ++d)
      lagrange(polynomial_degree, unit[d], shape[d], unused);
    Tensor<1, 3> sum;
    for (unsigned int k = 0; k < n; ++k)
      for (unsigned int j = 0; j < n; ++j)
        {
          const double yz = shape[1][j] * shape[2][k];
          for (unsigned int i = 0; i < n; ++i, ++u)
            {
              const double w = shape[0][i] * yz;
              for (unsigned int c = 0; c < 3; ++c)
                sum[c] += w * (*u)[c];
            }
        }
    return sum;
  }

  std::pair<Tensor<1, 3>, Tensor<2, 3>>
  HexahedralField::evaluate(const unsigned int cell, const Point<3> &unit) const
  {
    // One direction after the other.
    const unsigned int  n = polynomial_degree + 1;
    double              shape[3][4], slope[3][4];
    const Tensor<1, 3> *u = nodal_values.data() + std::size_t(cell) * nodes_per_cell();
    for (unsigned int d = 0; d < 3; ++d)
      lagrange(polynomial_degree, unit[d], shape[d], slope[d]);
    double sums[4][3] = {}; // derivatives, value; component
    for (unsigned int k = 0; k < n; ++k)
      {
        double in_plane[3][3] = {}; // d/dx, d/dy, value; component
        for (unsigned int j = 0; j < n; ++j)
          {
            double along[2][3] = {}; // d/dx, value
            for (unsigned int i = 0; i < n; ++i, ++u)
              for (unsigned int c = 0; c < 3; ++c)
                {
                  along[0][c] += slope[0][i] * (*u)[c];
                  along[1][c] += shape[0][i] * (*u)[c];
                }
            for (unsigned int c = 0; c < 3; ++c)
              {
                in_plane[0][c] += shape[1][j] * along[0][c];
                in_plane[1][c] += slope[1][j] * along[1][c];
                in_plane[2][c] += shape[1][j] * along[1][c];
              }
          }
        for (unsigned int c = 0; c < 3; ++c)
          {
            sums[0][c] += shape[2][k] * in_plane[0][c];
            sums[1][c] += shape[2][k] * in_plane[1][c];
            sums[2][c] += slope[2][k] * in_plane[2][c];
            sums[3][c] += shape[2][k] * in_plane[2][c];
          }
      }
    std::pair<Tensor<1, 3>, Tensor<2, 3>> result;
    for (unsigned int c = 0; c < 3; ++c)
      {
        result.first[c] = sums[3][c];
        for (unsigned int d = 0; d < 3; ++d)
          result.second[c][d] = sums[d][c] / cell_list[cell].size[d];
      }
    return result;
  }
} // namespace tetradapt::mesh
