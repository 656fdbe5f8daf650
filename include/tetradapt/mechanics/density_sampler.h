// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_density_sampler_h
#define tetradapt_mechanics_density_sampler_h

#include "tetradapt/mesh/simplex_parts.h"

#include <deal.II/base/point.h>

#include <functional>
#include <limits>
#include <vector>

namespace tetradapt::mechanics
{
  using dealii::Point;
  using dealii::Tensor;

  /** A point of a composite quadrature rule of a triangle (n = 3) or tetrahedron (n = 4). */
  template <unsigned int n>
  struct DensitySample
  {
    std::array<double, n> b;      ///< barycentric coordinates
    double                weight; ///< all of an element sum to one
    Tensor<1, 3>          value;  ///< of the density there
  };

  /** How elements are to be sampled. */
  template <unsigned int n>
  struct SamplingRules
  {
    /** Parts whose longest edge is below this are not cut further. */
    double finest = 0.;
    /** Triangles: parts whose longest edge is below this are divided along jumps, which are nearly
     * straight in them. */
    double straight = 0.;
    /** Mean of |density| over all that it acts on. */
    double mean = 0.;
    /** The accuracy of a part's mean density, relative to the mean of |density| in it or, where
     * that is larger, over all. Errors of different parts partly cancel. */
    double tolerance = n == 3 ? 3e-8 : 1e-6;
    /** Cells only: where part_size is infinite, parts that are longer than this are also looked at
     * along their rim, shorter ones are not. Faces always are: seven points leave a polynomial of
     * six coefficients too little to miss. */
    double without_rim = std::numeric_limits<double>::infinity();
    /** How long the edges of a part may be for nothing to be missed, given its corners, in
     * barycentric coordinates, and the box around it; empty: as long as they are. */
    std::function<
      double(const mesh::PartCorners<n> &corners, const Point<3> &lower, const Point<3> &upper)>
      part_size;
  };

  /**
   * Samples a vector function of the position over triangles or tetrahedra of a mesh so that
   * integrals of it times polynomials of low degree are accurate on every mesh.
   *
   * The element is cut, into 4 or 8 similar parts, until each part has the size at which the
   * function has been looked at, and is then cut where a quadratic polynomial does not fit the
   * values at the points of a rule of degree 5 (7 or 14 points; Gauss' and Walkington's,
   * dealii::QGaussSimplex). With the largest distance r from that polynomial and the largest
   * value v, the error of the rule's mean is taken as r min(1, r / (10 v)): of a smooth function
   * the polynomial misses the terms from order three on, the rule those from order six on. In
   * triangles, a jump along a line is located on two edges by bisection, and the part
   * is divided along it.
   */
  template <unsigned int n>
  class DensitySampler
  {
  public:
    using Function = std::function<Tensor<1, 3>(const Point<3> &)>;
    using Samples  = std::vector<DensitySample<n>>;

    DensitySampler();

    /**
     * Replaces @p samples by the rule for the element with corners @p corners.
     * @return an estimate of the remaining error of the mean density; zero where the
     *         accuracy has been reached.
     */
    double
    sample(const std::array<Point<3>, n> &corners,
           const Function                &density,
           const SamplingRules<n>        &rules,
           Samples                       &samples) const;

    /** Replaces @p samples by the basic rule, for functions that need no more. @return as
     * sample(). */
    double
    sample_basic(const std::array<Point<3>, n> &corners,
                 const Function                &density,
                 Samples                       &samples) const;

    /** Replaces a sample that stands for a constant by the basic rule with its value; leaves others
     * as they are. */
    void
    expand(Samples &samples) const;

  private:
    using Corners = mesh::PartCorners<n>;
    /** What sample() works on. */
    struct Work;
    struct Part;

    Part
    part_at(const Work &work, const Corners &corners) const;
    /** Evaluates the density in a part. */
    void
    look_at(Work &work, Part &part) const;
    static double
    allowed(const Work &work, const Part &part);
    bool
    fits(const Work &work, const Part &part) const;
    /** The rim: corners and middles of edges of a part, a little inside. */
    bool
    rim_fits(Work &work, const Part &part) const;
    Tensor<1, 3>
    refine(Work &work, const Corners &corners, double fraction, bool &was_limited) const;
    bool
    divide_at_jump(Work &work, const Part &part, double fraction) const;
    void
    keep(Work &work, const Part &part, double fraction) const;

    static constexpr unsigned int n_points    = n == 3 ? 7 : 14;
    static constexpr unsigned int n_functions = n * (n + 1) / 2; ///< also points of the rim

    std::vector<std::array<double, n>> rule_points, rim_points;
    std::vector<double>                rule_weights; ///< sum to one
    /** Functions spanning the quadratic polynomials at points, and the coefficients that fit. */
    std::array<std::array<double, n_functions>, n_points>    functions, fit;
    std::array<std::array<double, n_functions>, n_functions> rim_functions;
  };

  extern template class DensitySampler<3>;
  extern template class DensitySampler<4>;
} // namespace tetradapt::mechanics

#endif
