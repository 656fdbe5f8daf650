// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/estimate/adaptive_quadrature.h"

#include "tetradapt/compare/parallel.h"
#include "tetradapt/compare/tet_quadrature.h"
#include "tetradapt/core/failure.h"
#include "tetradapt/mesh/simplex_parts.h"

#include <deal.II/base/quadrature_lib.h>

#include <algorithm>
#include <cmath>

namespace tetradapt::estimate
{
  namespace
  {
    /** Parts 2^-12 of a cell are as good as points. */
    constexpr unsigned int last_level = 12;

    Point<3>
    position(const mesh::TetMesh &mesh, unsigned int cell, const mesh::Barycentric &b)
    {
      Point<3> x;
      for (unsigned int i = 0; i < 4; ++i)
        x += b[i] * dealii::Tensor<1, 3>(mesh.points[mesh.cells[cell][i]]);
      return x;
    }
  } // namespace

  template <unsigned int n_corners>
  AdaptiveQuadrature<n_corners>::AdaptiveQuadrature(const mesh::TetMesh &mesh,
                                                    const Densities     &densities)
    : mesh(mesh), densities(densities), low(make_rule(0)), middle(make_rule(1)), high(make_rule(2))
  {
    // Corners and middles of edges, but inside: jumps along faces of the mesh do no harm.
    constexpr double inwards = 1e-6;
    for (unsigned int i = 0; i < n_corners; ++i)
      for (unsigned int j = 0; j <= i; ++j)
        {
          std::array<double, n_corners> point;
          point.fill(inwards / n_corners);
          point[i] += 0.5 * (1. - inwards);
          point[j] += 0.5 * (1. - inwards);
          rim.points.push_back(point);
        }
    rim.weights.assign(rim.points.size(), 1. / rim.points.size());
  }

  template <unsigned int n_corners>
  typename AdaptiveQuadrature<n_corners>::Rule
  AdaptiveQuadrature<n_corners>::make_rule(unsigned int order)
  {
    Rule rule;
    if constexpr (n_corners == 4)
      {
        const auto &points = compare::tet_quadrature(order == 0 ? 2 : order == 1 ? 5 : 6);
        rule.points.assign(points.points.begin(), points.points.end());
        rule.weights = points.weights;
      }
    else
      {
        const dealii::QGaussSimplex<2> points(order + 2);
        for (unsigned int q = 0; q < points.size(); ++q)
          {
            const auto &p = points.point(q);
            rule.points.push_back({{1. - p[0] - p[1], p[0], p[1]}});
            rule.weights.push_back(2. * points.weight(q));
          }
      }
    return rule;
  }

  template <unsigned int n_corners>
  bool
  AdaptiveQuadrature<n_corners>::is_large(unsigned int cell, const Corners &corners) const
  {
    if (densities.constant)
      return false;
    std::array<Point<3>, n_corners> x;
    for (unsigned int i = 0; i < n_corners; ++i)
      x[i] = position(mesh, cell, corners[i]);
    double longest = 0.;
    for (unsigned int i = 0; i < n_corners; ++i)
      for (unsigned int j = 0; j < i; ++j)
        longest = std::max(longest, x[i].distance_square(x[j]));
    if (longest <= densities.largest_part * densities.largest_part)
      return false;
    // No part is farther from a corner than its longest edge.
    return x[0].distance(densities.center) <= std::sqrt(longest) + densities.radius;
  }

  template <unsigned int n_corners>
  typename AdaptiveQuadrature<n_corners>::Values
  AdaptiveQuadrature<n_corners>::integrate(unsigned int         cell,
                                           const Corners       &corners,
                                           double               measure,
                                           const Rule          &rule,
                                           std::vector<Values> &values) const
  {
    Values sum{};
    values.resize(rule.points.size());
    for (unsigned int q = 0; q < rule.points.size(); ++q)
      {
        const auto b = mesh::point_in_part<n_corners, 4>(corners, rule.points[q]);
        densities.evaluate(position(mesh, cell, b), values[q].data());
        for (unsigned int i = 0; i < densities.n; ++i)
          sum[i] += measure * rule.weights[q] * values[q][i];
      }
    return sum;
  }

  template <unsigned int n_corners>
  bool
  AdaptiveQuadrature<n_corners>::agree(const Values &a,
                                       const Values &b,
                                       const double *tolerances) const
  {
    for (unsigned int i = 0; i < densities.n; ++i)
      if (std::abs(a[i] - b[i]) > tolerances[i])
        return false;
    return true;
  }

  template <unsigned int n_corners>
  bool
  AdaptiveQuadrature<n_corners>::is_flat(const std::vector<Values> &all, const Values &first) const
  {
    for (const Values &value : all)
      for (unsigned int i = 0; i < densities.n; ++i)
        if (value[i] != first[i])
          return false;
    return true;
  }

  template <unsigned int n_corners>
  bool
  AdaptiveQuadrature<n_corners>::add_sizes(unsigned int   cell,
                                           const Corners &corners,
                                           double         measure,
                                           double        *sums) const
  {
    integrate(cell, corners, measure, low, values);
    integrate(cell, corners, measure, rim, others);
    bool found = !is_flat(values, Values{}) || !is_flat(others, Values{});
    // Also where values differ: few points in a patch say little of its integral, which
    // sets the tolerance for all.
    if (is_large(cell, corners))
      {
        found = false;
        mesh::for_children(corners, [&](const Corners &child) {
          found = add_sizes(cell, child, measure / (n_corners == 4 ? 8. : 4.), sums) || found;
        });
        return found;
      }
    for (unsigned int q = 0; q < values.size(); ++q)
      for (unsigned int i = 0; i < densities.n; ++i)
        sums[i] += measure * low.weights[q] * std::abs(values[q][i]);
    return found;
  }

  template <unsigned int n_corners>
  bool
  AdaptiveQuadrature<n_corners>::is_smooth(double measure, const double *tolerances) const
  {
    for (unsigned int i = 0; i < densities.n; ++i)
      {
        double       least = values[0][i], largest = least;
        unsigned int zeros = 0, extremes = 0;
        for (const Values &value : values)
          {
            least   = std::min(least, value[i]);
            largest = std::max(largest, value[i]);
            zeros += value[i] == 0.;
          }
        for (const Values &value : values)
          extremes += value[i] == least || value[i] == largest;
        const bool jumps
          = (zeros > 0 && zeros < values.size()) || (least < largest && extremes == values.size());
        if (jumps && measure * (largest - least) > 20. * tolerances[i])
          return false;
      }
    return true;
  }

  template <unsigned int n_corners>
  bool
  AdaptiveQuadrature<n_corners>::is_accurate(unsigned int   cell,
                                             const Corners &corners,
                                             double         measure,
                                             const Values  &sum,
                                             const double  *tolerances) const
  {
    if (!is_flat(values, values[0]))
      return is_smooth(measure, tolerances)
             && (agree(sum, integrate(cell, corners, measure, low, others), tolerances)
                 || agree(sum, integrate(cell, corners, measure, high, others), tolerances));
    // A jump between the rim and the first points cuts off a tenth at most.
    Values tenth = integrate(cell, corners, measure, rim, others);
    for (unsigned int i = 0; i < densities.n; ++i)
      tenth[i] = sum[i] + 0.1 * (tenth[i] - sum[i]);
    return agree(sum, tenth, tolerances) && !is_large(cell, corners);
  }

  template <unsigned int n_corners>
  void
  AdaptiveQuadrature<n_corners>::visit(unsigned int   cell,
                                       const Corners &corners,
                                       double         measure,
                                       const double  *tolerances,
                                       const Visitor &visitor) const
  {
    refine(cell, corners, measure, tolerances, 0, visitor);
  }

  template <unsigned int n_corners>
  void
  AdaptiveQuadrature<n_corners>::refine(unsigned int   cell,
                                        const Corners &corners,
                                        double         measure,
                                        const double  *tolerances,
                                        unsigned int   level,
                                        const Visitor &visitor) const
  {
    const Values sum  = integrate(cell, corners, measure, middle, values);
    const bool   good = densities.constant || level == last_level
                      || is_accurate(cell, corners, measure, sum, tolerances);
    if (!good)
      {
        mesh::for_children(corners, [&](const Corners &child) {
          refine(cell, child, measure / (n_corners == 4 ? 8. : 4.), tolerances, level + 1, visitor);
        });
        return;
      }
    for (unsigned int q = 0; q < values.size(); ++q)
      if (std::any_of(values[q].begin(), values[q].begin() + densities.n, [](double value) {
            return value != 0.;
          }))
        visitor(mesh::point_in_part<n_corners, 4>(corners, middle.points[q]),
                measure * middle.weights[q],
                values[q].data());
  }

  template class AdaptiveQuadrature<3>;
  template class AdaptiveQuadrature<4>;

  template <unsigned int n_corners>
  void
  visit_parts(const mesh::TetMesh                                           &mesh,
              const Densities                                               &densities,
              unsigned int                                                   n_parts,
              const std::function<IntegrationPart<n_corners>(unsigned int)> &part,
              double                                                         accuracy,
              MPI_Comm                                                       communicator,
              const PointVisitor                                            &visitor)
  {
    const AdaptiveQuadrature<n_corners> quadrature(mesh, densities);
    std::vector<double>                 tolerances(densities.n, 0.);
    std::vector<unsigned int>           needed; // where there is anything
    core::together(communicator, [&] {
      for (unsigned int k = 0; k < n_parts; ++k)
        {
          const auto p = part(k);
          if (densities.constant
              || quadrature.add_sizes(p.cell, p.corners, p.measure, tolerances.data()))
            needed.push_back(k);
        }
    });
    compare::sum_over_ranks(tolerances, communicator);
    for (double &tolerance : tolerances)
      tolerance *= accuracy;
    core::together(communicator, [&] {
      for (const unsigned int k : needed)
        {
          const auto p = part(k);
          quadrature.visit(p.cell,
                           p.corners,
                           p.measure,
                           tolerances.data(),
                           [&](const mesh::Barycentric &b, double weight, const double *values) {
                             visitor(p.cell, b, weight, values);
                           });
        }
    });
  }

  template void
  visit_parts<3>(const mesh::TetMesh &,
                 const Densities &,
                 unsigned int,
                 const std::function<IntegrationPart<3>(unsigned int)> &,
                 double,
                 MPI_Comm,
                 const PointVisitor &);
  template void
  visit_parts<4>(const mesh::TetMesh &,
                 const Densities &,
                 unsigned int,
                 const std::function<IntegrationPart<4>(unsigned int)> &,
                 double,
                 MPI_Comm,
                 const PointVisitor &);
} // namespace tetradapt::estimate
