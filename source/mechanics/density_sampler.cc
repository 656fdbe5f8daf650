// SPDX-License-Identifier: AGPL-3.0-or-later
#include "tetradapt/mechanics/density_sampler.h"

#include <deal.II/base/quadrature_lib.h>
#include <deal.II/lac/full_matrix.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace tetradapt::mechanics
{
  namespace
  {
    /** Products of two barycentric coordinates span the quadratic polynomials. */
    template <unsigned int n>
    std::array<double, n *(n + 1) / 2>
    quadratics(const std::array<double, n> &b)
    {
      std::array<double, n *(n + 1) / 2> values;
      unsigned int                       k = 0;
      for (unsigned int i = 0; i < n; ++i)
        for (unsigned int j = 0; j <= i; ++j)
          values[k++] = b[i] * b[j];
      return values;
    }

    template <unsigned int n>
    Point<3>
    position(const std::array<Point<3>, n> &corners, const std::array<double, n> &b)
    {
      Point<3> x;
      for (unsigned int i = 0; i < n; ++i)
        x += b[i] * Tensor<1, 3>(corners[i]);
      return x;
    }

    template <unsigned int n>
    mesh::PartCorners<n>
    whole_element_corners()
    {
      mesh::PartCorners<n> corners{};
      for (unsigned int i = 0; i < n; ++i)
        corners[i][i] = 1.;
      return corners;
    }

    /** Rounding is no difference. */
    constexpr double rounding = 1e-13;

    /** What a rule's error is expected to be, given how far the values are from a quadratic
     * polynomial and how large they are. */
    double
    expected_error(const double distance, const double largest)
    {
      if (distance <= rounding * largest)
        return 0.;
      return distance * std::min(1., distance / (10. * largest));
    }
  } // namespace

  template <unsigned int n>
  struct DensitySampler<n>::Work
  {
    const std::array<Point<3>, n> &corners;
    const Function                &density;
    const SamplingRules<n>        &rules;
    Samples                       &samples;
    Tensor<1, 3>                   change{}; ///< of integrals by the last cut that was allowed
    double                         rough           = 0.;
    double                         squared_changes = 0.;
    bool                           unknown = false; ///< parts without a coarser one to compare

    Tensor<1, 3>
    operator()(const std::array<double, n> &b)
    {
      return density(position<n>(corners, b));
    }
  };

  template <unsigned int n>
  struct DensitySampler<n>::Part
  {
    Corners                                     corners;
    std::array<std::array<double, n>, n_points> points;
    std::array<Tensor<1, 3>, n_points>          values;
    std::array<Tensor<1, 3>, n_functions>       polynomial;
    Tensor<1, 3>                                mean;
    double   distance = 0., largest = 0.; ///< from the polynomial; value
    double   mean_size = 0.;              ///< of |value|
    double   size      = 0.;              ///< longest edge
    Point<3> lower, upper;
  };

  template <unsigned int n>
  DensitySampler<n>::DensitySampler()
  {
    const dealii::QGaussSimplex<n - 1> rule(3);
    for (unsigned int q = 0; q < rule.size(); ++q)
      {
        std::array<double, n> b;
        b[0] = 1.;
        for (unsigned int d = 0; d + 1 < n; ++d)
          {
            b[d + 1] = rule.point(q)[d];
            b[0] -= b[d + 1];
          }
        rule_points.push_back(b);
        rule_weights.push_back((n == 3 ? 2. : 6.) * rule.weight(q));
        functions[q] = quadratics<n>(b);
      }
    constexpr double inwards = 1e-6;
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j <= i; ++j)
        {
          std::array<double, n> b;
          b.fill(inwards / n);
          b[i] += 0.5 * (1. - inwards);
          b[j] += 0.5 * (1. - inwards);
          rim_functions[rim_points.size()] = quadratics<n>(b);
          rim_points.push_back(b);
        }
    dealii::FullMatrix<double> products(n_functions, n_functions);
    for (unsigned int q = 0; q < n_points; ++q)
      for (unsigned int i = 0; i < n_functions; ++i)
        for (unsigned int j = 0; j < n_functions; ++j)
          products(i, j) += rule_weights[q] * functions[q][i] * functions[q][j];
    products.gauss_jordan();
    for (unsigned int q = 0; q < n_points; ++q)
      for (unsigned int i = 0; i < n_functions; ++i)
        {
          fit[q][i] = 0.;
          for (unsigned int j = 0; j < n_functions; ++j)
            fit[q][i] += products(i, j) * rule_weights[q] * functions[q][j];
        }
  }

  template <unsigned int n>
  typename DensitySampler<n>::Part
  DensitySampler<n>::part_at(const Work &work, const Corners &corners) const
  {
    Part part;
    part.corners = corners;
    std::array<Point<3>, n> x;
    for (unsigned int i = 0; i < n; ++i)
      x[i] = position<n>(work.corners, corners[i]);
    part.lower = part.upper = x[0];
    for (unsigned int i = 1; i < n; ++i)
      for (unsigned int d = 0; d < 3; ++d)
        {
          part.lower[d] = std::min(part.lower[d], x[i][d]);
          part.upper[d] = std::max(part.upper[d], x[i][d]);
        }
    for (unsigned int i = 0; i < n; ++i)
      for (unsigned int j = 0; j < i; ++j)
        part.size = std::max(part.size, x[i].distance(x[j]));
    return part;
  }

  template <unsigned int n>
  void
  DensitySampler<n>::look_at(Work &work, Part &part) const
  {
    for (unsigned int q = 0; q < n_points; ++q)
      {
        part.points[q] = mesh::point_in_part<n, n>(part.corners, rule_points[q]);
        part.values[q] = work(part.points[q]);
        part.mean += rule_weights[q] * part.values[q];
        const double size = part.values[q].norm();
        part.mean_size += rule_weights[q] * size;
        part.largest = std::max(part.largest, size);
        for (unsigned int i = 0; i < n_functions; ++i)
          part.polynomial[i] += fit[q][i] * part.values[q];
      }
    for (unsigned int q = 0; q < n_points; ++q)
      {
        Tensor<1, 3> rest = part.values[q];
        for (unsigned int i = 0; i < n_functions; ++i)
          rest -= functions[q][i] * part.polynomial[i];
        part.distance = std::max(part.distance, rest.norm());
      }
  }

  template <unsigned int n>
  double
  DensitySampler<n>::allowed(const Work &work, const Part &part)
  {
    return work.rules.tolerance * std::max(work.rules.mean, part.mean_size);
  }

  template <unsigned int n>
  bool
  DensitySampler<n>::fits(const Work &work, const Part &part) const
  {
    return expected_error(part.distance, part.largest) <= allowed(work, part);
  }

  template <unsigned int n>
  bool
  DensitySampler<n>::rim_fits(Work &work, const Part &part) const
  {
    double distance = 0., largest = part.largest;
    for (unsigned int k = 0; k < n_functions; ++k)
      {
        Tensor<1, 3> rest = work(mesh::point_in_part<n, n>(part.corners, rim_points[k]));
        largest           = std::max(largest, rest.norm());
        for (unsigned int i = 0; i < n_functions; ++i)
          rest -= rim_functions[k][i] * part.polynomial[i];
        distance = std::max(distance, rest.norm());
      }
    // Outside of the points a polynomial is several times as far from a smooth function.
    distance = distance < 0.2 * largest ? 0.1 * distance : distance;
    return expected_error(distance, largest) <= allowed(work, part);
  }

  template <unsigned int n>
  void
  DensitySampler<n>::keep(Work &work, const Part &part, const double fraction) const
  {
    for (unsigned int q = 0; q < n_points; ++q)
      work.samples.push_back({part.points[q], fraction * rule_weights[q], part.values[q]});
  }

  template <unsigned int n>
  bool
  DensitySampler<n>::divide_at_jump([[maybe_unused]] Work        &work,
                                    [[maybe_unused]] const Part  &part,
                                    [[maybe_unused]] const double fraction) const
  {
    if constexpr (n == 3)
      {
        // Where the values on an edge jump: edge i is opposite to corner i.
        double                                     jump[3] = {0., 0., 0.};
        std::array<std::array<double, n>, 3>       before, after;
        const std::array<std::array<double, n>, 3> ends{
          {mesh::point_in_part<n, n>(part.corners, rim_points[0]),
           mesh::point_in_part<n, n>(part.corners, rim_points[2]),
           mesh::point_in_part<n, n>(part.corners, rim_points[5])}};
        std::array<Tensor<1, 3>, 3> values;
        for (unsigned int i = 0; i < 3; ++i)
          values[i] = work(ends[i]);
        for (unsigned int i = 0; i < 3; ++i)
          {
            auto         a = ends[(i + 1) % 3], b = ends[(i + 2) % 3];
            Tensor<1, 3> at_a = values[(i + 1) % 3], at_b = values[(i + 2) % 3];
            const double whole = (at_b - at_a).norm();
            if (whole <= 0.1 * part.largest)
              continue;
            for (unsigned int step = 0; step < 24; ++step)
              {
                const auto         m     = mesh::middle_of(a, b);
                const Tensor<1, 3> at_m  = work(m);
                const bool         first = (at_m - at_a).norm() > (at_b - at_m).norm();
                (first ? b : a)          = m;
                (first ? at_b : at_a)    = at_m;
              }
            before[i] = a;
            after[i]  = b;
            jump[i]   = (at_b - at_a).norm() > 0.5 * whole ? whole : 0.;
          }
        for (unsigned int i = 0; i < 3; ++i)
          {
            const unsigned int j = (i + 1) % 3, k = (i + 2) % 3;
            if (jump[i] > 0. || jump[j] == 0. || jump[k] == 0.)
              continue;
            // The line cuts corner i off: it crosses edge j between corners k and i, edge k between
            // corners i and j.
            const auto            on_j      = mesh::middle_of(before[j], after[j]);
            const auto            on_k      = mesh::middle_of(before[k], after[k]);
            const Corners         pieces[3] = {{{part.corners[i], on_k, on_j}},
                                               {{on_k, part.corners[j], part.corners[k]}},
                                               {{on_k, part.corners[k], on_j}}};
            std::array<Part, 3>   parts;
            std::array<double, 3> shares;
            for (unsigned int p = 0; p < 3; ++p)
              {
                parts[p] = part_at(work, pieces[p]);
                look_at(work, parts[p]);
                if (!fits(work, parts[p]))
                  return false;
                // Areas of barycentric coordinates, as a part of that of the whole element.
                const auto &c = pieces[p];
                shares[p]     = std::abs((c[1][1] - c[0][1]) * (c[2][2] - c[0][2])
                                     - (c[2][1] - c[0][1]) * (c[1][2] - c[0][2]));
              }
            const double all = shares[0] + shares[1] + shares[2];
            for (unsigned int p = 0; p < 3; ++p)
              keep(work, parts[p], fraction * shares[p] / all);
            return true;
          }
      }
    return false; // parts of cells are small enough
  }

  template <unsigned int n>
  Tensor<1, 3>
  DensitySampler<n>::refine(Work          &work,
                            const Corners &corners,
                            const double   fraction,
                            bool          &was_limited) const
  {
    const SamplingRules<n> &rules = work.rules;
    Part                    part  = part_at(work, corners);
    const double look     = rules.part_size ? rules.part_size(corners, part.lower, part.upper)
                                            : std::numeric_limits<double>::infinity();
    const bool   is_small = part.size <= look;
    was_limited           = false;
    if (is_small)
      {
        look_at(work, part);
        if (fits(work, part)
            && ((n == 4 && look == std::numeric_limits<double>::infinity()
                 && part.size <= rules.without_rim)
                || rim_fits(work, part)))
          {
            keep(work, part, fraction);
            return fraction * part.mean;
          }
        if (part.size <= rules.straight && divide_at_jump(work, part, fraction))
          {
            Tensor<1, 3> sum;
            for (std::size_t i = work.samples.size() - 3 * n_points; i < work.samples.size(); ++i)
              sum += work.samples[i].weight * work.samples[i].value;
            return sum;
          }
        if (part.size <= rules.finest)
          {
            keep(work, part, fraction);
            work.rough += fraction * part.distance;
            was_limited = true;
            return fraction * part.mean;
          }
      }
    Tensor<1, 3> sum;
    bool         limited_below = false;
    mesh::for_children(corners, [&](const Corners &child) {
      bool limited = false;
      sum += refine(work, child, fraction / (n == 3 ? 4. : 8.), limited);
      limited_below = limited_below || limited;
    });
    // Larger parts were not looked at: their children count with all that is rough in them.
    if (limited_below && is_small)
      {
        const Tensor<1, 3> change = sum - fraction * part.mean;
        work.change += change;
        work.squared_changes += change.norm_square();
      }
    else if (limited_below)
      work.unknown = true;
    return sum;
  }

  template <unsigned int n>
  double
  DensitySampler<n>::sample(const std::array<Point<3>, n> &corners,
                            const Function                &density,
                            const SamplingRules<n>        &rules,
                            Samples                       &samples) const
  {
    samples.clear();
    Work work{corners, density, rules, samples};
    bool was_limited = false;
    refine(work, whole_element_corners<n>(), 1., was_limited);
    // Errors of parts partly cancel: what the last cut changed tells more than their sum.
    const double changed = work.change.norm() + 2. * std::sqrt(work.squared_changes);
    return was_limited || work.unknown ? 0.25 * work.rough : std::min(changed, work.rough);
  }

  template <unsigned int n>
  double
  DensitySampler<n>::sample_basic(const std::array<Point<3>, n> &corners,
                                  const Function                &density,
                                  Samples                       &samples) const
  {
    samples.clear();
    const SamplingRules<n> rules;
    Work                   work{corners, density, rules, samples};
    Part                   part = part_at(work, whole_element_corners<n>());
    look_at(work, part);
    keep(work, part, 1.);
    return expected_error(part.distance, part.largest);
  }

  template <unsigned int n>
  void
  DensitySampler<n>::expand(Samples &samples) const
  {
    if (samples.size() != 1)
      return;
    const Tensor<1, 3> value = samples[0].value;
    samples.clear();
    for (unsigned int q = 0; q < n_points; ++q)
      samples.push_back({rule_points[q], rule_weights[q], value});
  }

  template class DensitySampler<3>;
  template class DensitySampler<4>;
} // namespace tetradapt::mechanics
