// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/solve/hexahedral_stiffness.h"

#include "tetradapt/core/clones.h"
#include "tetradapt/core/exceptions.h"
#include "tetradapt/core/lanes.h"
#include "tetradapt/mesh/hexahedral_field.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace tetradapt::solve
{
  namespace
  {
    using core::Lanes; // one number of eight cells
    using core::n_lanes;

    constexpr unsigned int most_dofs = 3 * 4 * 4 * 4; ///< of a cell, degree 3

    constexpr unsigned int none = HexahedralGrid::none;

    /** What cells of one degree have in common. */
    struct Shape
    {
      unsigned int n      = 3; ///< nodes along an edge
      unsigned int n_dofs = 81;
      /** Unknowns (3 node + component), set by set; the sets' sizes are multiples of 3. */
      std::vector<unsigned int> order;
      unsigned int              begin[9] = {};
    };

    /** Whether position @p k of n along an edge holds a difference once sums and
     * differences were formed. */
    bool
    is_odd(const unsigned int k, const unsigned int n)
    {
      return 2 * k > n - 1;
    }

    Shape
    make_shape(const unsigned int degree)
    {
      Shape shape;
      shape.n              = degree + 1;
      shape.n_dofs         = 3 * shape.n * shape.n * shape.n;
      const unsigned int n = shape.n;
      for (unsigned int set = 0; set < 8; ++set)
        {
          shape.begin[set] = shape.order.size();
          for (unsigned int node = 0; node < n * n * n; ++node)
            for (unsigned int c = 0; c < 3; ++c)
              {
                const unsigned int k[3] = {node % n, node / n % n, node / n / n};
                unsigned int       key  = 1u << c; // a component changes sign with its axis
                for (unsigned int d = 0; d < 3; ++d)
                  key ^= static_cast<unsigned int>(is_odd(k[d], n)) << d;
                if (key == set)
                  shape.order.push_back(3 * node + c);
              }
        }
      shape.begin[8] = shape.order.size();
      return shape;
    }

    /** Replaces mirrored values by their sums and differences, along each axis. */
    template <unsigned int n, typename Number>
    inline void
    fold(Number *x)
    {
      unsigned int stride = 3;
      for (unsigned int d = 0; d < 3; ++d, stride *= n)
        for (unsigned int outer = 0; outer < 3 * n * n * n; outer += n * stride)
          for (unsigned int inner = outer; inner < outer + stride; ++inner)
            for (unsigned int k = 0; 2 * k < n - 1; ++k)
              {
                Number      &a = x[inner + k * stride], &b = x[inner + (n - 1 - k) * stride];
                const Number sum = a + b;
                b                = a - b;
                a                = sum;
              }
    }

    /** y = K x for eight cells; x is spoilt. */
    template <unsigned int n>
    inline void
    multiply_cells(const Shape &shape, const double *matrix, Lanes *x, Lanes *y)
    {
      fold<n>(x);
      for (unsigned int set = 0; set < 8; ++set)
        {
          const unsigned int *const begin = shape.order.data() + shape.begin[set];
          const unsigned int        size  = shape.begin[set + 1] - shape.begin[set];
          for (unsigned int row = 0; row < size; row += 3)
            {
              Lanes sum[3] = {};
              for (unsigned int column = 0; column < size; ++column, matrix += 3)
                {
                  const Lanes value = x[begin[column]];
                  for (unsigned int r = 0; r < 3; ++r)
                    sum[r] += matrix[r] * value;
                }
              for (unsigned int r = 0; r < 3; ++r)
                y[begin[row + r]] = sum[r];
            }
        }
      fold<n>(y);
    }

    TETRADAPT_CLONES void
    multiply(const Shape &shape, const double *matrix, Lanes *x, Lanes *y)
    {
      if (shape.n == 2)
        multiply_cells<2>(shape, matrix, x, y);
      else if (shape.n == 3)
        multiply_cells<3>(shape, matrix, x, y);
      else
        multiply_cells<4>(shape, matrix, x, y);
    }

    /** The inverse of fold() on unfolded unknowns, transposed: on forces. */
    void
    unfold(std::vector<double> &values, const unsigned int n)
    {
      if (n == 2)
        fold<2>(values.data());
      else if (n == 3)
        fold<3>(values.data());
      else
        fold<4>(values.data());
      for (unsigned int dof = 0; dof < values.size(); ++dof)
        {
          const unsigned int node = dof / 3, k[3] = {node % n, node / n % n, node / n / n};
          for (const unsigned int position : k)
            values[dof] *= 2 * position == n - 1 ? 1. : .5;
        }
    }

    /** The element's matrix for folded unknowns: the sets one after another, three
     * rows at a time, column by column. */
    std::vector<double>
    folded_matrix(const Shape &shape, const HexahedralElement &element)
    {
      const unsigned int               size = shape.n_dofs;
      std::vector<std::vector<double>> matrix(size, std::vector<double>(size));
      double                           largest = 0.;
      for (unsigned int a = 0; a < size; ++a)
        {
          for (unsigned int b = 0; b < size; ++b)
            matrix[a][b] = element.entry(a / 3, a % 3, b / 3, b % 3);
          unfold(matrix[a], shape.n);
        }
      std::vector<double> column(size);
      for (unsigned int b = 0; b < size; ++b)
        {
          for (unsigned int a = 0; a < size; ++a)
            column[a] = matrix[a][b];
          unfold(column, shape.n);
          for (unsigned int a = 0; a < size; ++a)
            {
              matrix[a][b] = column[a];
              largest      = std::max(largest, std::abs(column[a]));
            }
        }
      std::vector<double> result;
      double              coupling = 0.;
      for (unsigned int set = 0; set < 8; ++set)
        for (unsigned int row = shape.begin[set]; row < shape.begin[set + 1]; row += 3)
          for (unsigned int other = 0; other < size; ++other)
            for (unsigned int r = 0; r < 3; ++r)
              {
                const double value = matrix[shape.order[row + r]][shape.order[other]];
                if (other >= shape.begin[set] && other < shape.begin[set + 1])
                  result.push_back(value);
                else
                  coupling = std::max(coupling, std::abs(value));
              }
      if (coupling > 1e-10 * largest)
        throw core::InputError("Reference/Type: hexahedra can be used only for materials that are "
                               "symmetric about the coordinate planes. Use Type = fine mesh.");
      return result;
    }
  } // namespace

  HexahedralElement::HexahedralElement(const unsigned int                degree,
                                       const Tensor<1, 3>               &size,
                                       const mechanics::ConstitutiveLaw &law)
    : n(degree + 1), integrals(4 * n * n, 0.)
  {
    const dealii::QGauss<1> gauss(n);
    for (unsigned int q = 0; q < n; ++q)
      {
        double shape[2][4];
        mesh::lagrange(degree, gauss.point(q)[0], shape[0], shape[1]);
        for (unsigned int kind = 0; kind < 4; ++kind)
          for (unsigned int a = 0; a < n; ++a)
            for (unsigned int b = 0; b < n; ++b)
              integrals[(kind * n + a) * n + b]
                += gauss.weight(q) * shape[kind >> 1][a] * shape[kind & 1][b];
      }
    const auto   tangent = law.tangent(Tensor<2, 3>());
    const double volume  = size[0] * size[1] * size[2];
    for (unsigned int i = 0; i < 3; ++i)
      for (unsigned int k = 0; k < 3; ++k)
        for (unsigned int j = 0; j < 3; ++j)
          for (unsigned int l = 0; l < 3; ++l)
            coefficients[i][k][j][l] = tangent[i][k][j][l] * volume / (size[k] * size[l]);
  }

  double
  HexahedralElement::entry(const unsigned int a,
                           const unsigned int i,
                           const unsigned int b,
                           const unsigned int j) const
  {
    const unsigned int at[3] = {a % n, a / n % n, a / n / n};
    const unsigned int bt[3] = {b % n, b / n % n, b / n / n};
    double             sum   = 0.;
    for (unsigned int k = 0; k < 3; ++k)
      for (unsigned int l = 0; l < 3; ++l)
        if (coefficients[i][k][j][l] != 0.)
          {
            double product = coefficients[i][k][j][l];
            for (unsigned int d = 0; d < 3; ++d)
              product *= integrals[((2 * (k == d) + (l == d)) * n + at[d]) * n + bt[d]];
            sum += product;
          }
    return sum;
  }

  struct HexahedralStiffness::Kind
  {
    int                 region;
    Tensor<1, 3>        size; ///< of the brick
    HexahedralElement   element;
    std::vector<double> matrix;
  };

  HexahedralStiffness::HexahedralStiffness(const HexahedralForest       &forest,
                                           const HexahedralSpace        &space,
                                           const mechanics::MaterialMap &materials)
    : forest(forest), space(space)
  {
    const HexahedralGrid     &grid  = forest.grid();
    const Shape               shape = make_shape(space.degree);
    std::vector<unsigned int> kind_of_brick(grid.n_bricks(), none);
    for (const HexahedralCell &cell : forest.cells())
      {
        unsigned int &kind = kind_of_brick[cell.brick];
        if (kind == none)
          {
            const int          region = grid.regions[cell.brick];
            const Tensor<1, 3> size   = grid.corner(cell.brick, 7) - grid.corner(cell.brick, 0);
            for (kind = 0; kind < kinds.size(); ++kind)
              if (kinds[kind].region == region
                  && (kinds[kind].size - size).norm() < 1e-12 * size.norm())
                break;
            if (kind == kinds.size())
              {
                HexahedralElement element(space.degree, size, materials.law(region));
                auto              matrix = folded_matrix(shape, element);
                kinds.push_back({region, size, std::move(element), std::move(matrix)});
              }
          }
        kind_of.push_back(kind);
        // Halving a cell multiplies the derivatives' squares by four and divides the
        // volume by eight.
        scales.push_back(std::ldexp(1., -static_cast<int>(cell.level)));
      }
    std::vector<std::vector<unsigned int>> cells_of(kinds.size());
    for (unsigned int c = 0; c < kind_of.size(); ++c)
      cells_of[kind_of[c]].push_back(c);
    for (auto &cells : cells_of)
      {
        cells.resize((cells.size() + n_lanes - 1) / n_lanes * n_lanes, none);
        batches.insert(batches.end(), cells.begin(), cells.end());
      }
  }

  HexahedralStiffness::~HexahedralStiffness() = default;

  const HexahedralElement &
  HexahedralStiffness::element(const unsigned int cell) const
  {
    return kinds[kind_of[cell]].element;
  }

  void
  HexahedralStiffness::vmult(Vector &forces, const Vector &displacement) const
  {
    const Shape shape = make_shape(space.degree);
    Lanes       x[most_dofs], y[most_dofs];
    displacement.update_ghost_values();
    forces                   = 0.;
    const double *const from = displacement.begin();
    double *const       to   = forces.begin();
    const unsigned int  n    = space.nodes_per_cell;
    for (std::size_t batch = 0; batch < batches.size(); batch += n_lanes)
      {
        for (unsigned int lane = 0; lane < n_lanes; ++lane)
          {
            const unsigned int cell = batches[batch + lane];
            if (cell == none)
              {
                for (unsigned int i = 0; i < shape.n_dofs; ++i)
                  x[i][lane] = 0.;
                continue;
              }
            const unsigned int *const nodes = space.nodes(cell);
            for (unsigned int i = 0; i < n; ++i)
              if (nodes[i] < space.n_local)
                for (unsigned int c = 0; c < 3; ++c)
                  x[3 * i + c][lane] = from[3 * std::size_t(nodes[i]) + c];
              else
                {
                  const Tensor<1, 3> value = space.value(displacement, nodes[i]);
                  for (unsigned int c = 0; c < 3; ++c)
                    x[3 * i + c][lane] = value[c];
                }
          }
        multiply(shape, kinds[kind_of[batches[batch]]].matrix.data(), x, y);
        for (unsigned int lane = 0; lane < n_lanes && batches[batch + lane] != none; ++lane)
          {
            const unsigned int        cell   = batches[batch + lane];
            const unsigned int *const nodes  = space.nodes(cell);
            const double              factor = scales[cell];
            for (unsigned int i = 0; i < n; ++i)
              if (nodes[i] < space.n_local)
                for (unsigned int c = 0; c < 3; ++c)
                  to[3 * std::size_t(nodes[i]) + c] += factor * y[3 * i + c][lane];
              else
                {
                  Tensor<1, 3> force;
                  for (unsigned int c = 0; c < 3; ++c)
                    force[c] = factor * y[3 * i + c][lane];
                  space.add(forces, nodes[i], force);
                }
          }
      }
    forces.compress(dealii::VectorOperation::add);
    displacement.zero_out_ghost_values();
  }

  Vector
  HexahedralStiffness::diagonal() const
  {
    Vector diagonal(space.layout);
    struct Part
    {
      unsigned int node, position;
      double       weight;
    };
    std::vector<Part> parts; // what a cell's nodes are made of
    // Entries that couple a component with itself, of each kind of cell.
    const unsigned int               n = space.nodes_per_cell;
    std::vector<std::vector<double>> entries(kinds.size());
    for (unsigned int k = 0; k < kinds.size(); ++k)
      for (unsigned int a = 0; a < n; ++a)
        for (unsigned int b = 0; b < n; ++b)
          for (unsigned int c = 0; c < 3; ++c)
            entries[k].push_back(kinds[k].element.entry(a, c, b, c));
    for (unsigned int cell = 0; cell < kind_of.size(); ++cell)
      {
        const unsigned int *const  nodes = space.nodes(cell);
        const std::vector<double> &K     = entries[kind_of[cell]];
        parts.clear();
        for (unsigned int i = 0; i < n; ++i)
          space.expand(nodes[i], [&](unsigned int node, double weight) {
            parts.push_back({node, i, weight});
          });
        std::sort(parts.begin(), parts.end(), [](const Part &a, const Part &b) {
          return a.node < b.node;
        });
        for (std::size_t first = 0, last; first < parts.size(); first = last)
          {
            for (last = first; last < parts.size() && parts[last].node == parts[first].node;)
              ++last;
            double sum[3] = {0., 0., 0.};
            for (std::size_t a = first; a < last; ++a)
              for (std::size_t b = first; b < last; ++b)
                for (unsigned int c = 0; c < 3; ++c)
                  sum[c] += parts[a].weight * parts[b].weight
                            * K[3 * (n * parts[a].position + parts[b].position) + c];
            for (unsigned int c = 0; c < 3; ++c)
              diagonal.local_element(3 * parts[first].node + c) += scales[cell] * sum[c];
          }
      }
    diagonal.compress(dealii::VectorOperation::add);
    return diagonal;
  }
} // namespace tetradapt::solve
