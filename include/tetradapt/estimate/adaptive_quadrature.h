// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_adaptive_quadrature_h
#define tetradapt_estimate_adaptive_quadrature_h

#include "tetradapt/mesh/nodal_field.h"

#include <mpi.h>

#include <functional>
#include <limits>

namespace tetradapt::estimate
{
  using dealii::Point;

  /** Functions of the position to be integrated together. */
  struct Densities
  {
    static constexpr unsigned int most = 9;

    unsigned int                                    n = 1; ///< at most most
    std::function<void(const Point<3> &, double *)> evaluate;
    bool                                            constant = false;
    double largest_part = 0.; ///< longest edge of a part in which they do not vary
    /** They are zero outside of the ball around center; infinity: nothing is known. */
    double   radius = std::numeric_limits<double>::infinity();
    Point<3> center;
  };

  /**
   * Integrates functions over cells or faces of a mesh, whatever the mesh does not know of
   * them: a weight that is zero but in a small patch, or jumps. Parts are cut (into
   * 8, or 4) where rules of two degrees do not agree to a tolerance, and also where the
   * densities are the same at all points, as long as they are longer than the
   * densities' largest_part: a patch or a hole may lie between the points.
   *
   * @tparam n_corners 4 for cells, 3 for faces.
   */
  template <unsigned int n_corners>
  class AdaptiveQuadrature
  {
  public:
    using Corners = std::array<mesh::Barycentric, n_corners>;
    /** Is told each point: where, its weight times the measure, and the densities. */
    using Visitor = std::function<void(const mesh::Barycentric &, double, const double *)>;

    /** Keeps references. */
    AdaptiveQuadrature(const mesh::TetMesh &mesh, const Densities &densities);

    /** Adds the integrals of the sizes |density| over a cell or face, with the points
     * of the coarsest rule, to @p sums. @return whether there is anything. */
    bool
    add_sizes(unsigned int cell, const Corners &corners, double measure, double *sums) const;

    /** Visits the points of a rule that is accurate to @p tolerances, one a density. */
    void
    visit(unsigned int   cell,
          const Corners &corners,
          double         measure,
          const double  *tolerances,
          const Visitor &visitor) const;

  private:
    struct Rule
    {
      std::vector<std::array<double, n_corners>> points;
      std::vector<double>                        weights; ///< sum to 1
    };
    using Values = std::array<double, Densities::most>;

    static Rule
    make_rule(unsigned int order);
    /** Whether all values are @p first. */
    bool
    is_flat(const std::vector<Values> &all, const Values &first) const;
    /** Whether no density jumps among the values at hand, to zero or between two values,
     * by more than is allowed: where a jump cuts a part in halves, rules of any degree
     * agree, and are wrong. */
    bool
    is_smooth(double measure, const double *tolerances) const;
    /** Whether the integrals @p sum of the values at hand can be trusted. */
    bool
    is_accurate(unsigned int   cell,
                const Corners &corners,
                double         measure,
                const Values  &sum,
                const double  *tolerances) const;
    bool
    is_large(unsigned int cell, const Corners &corners) const;
    /** Densities at the points of a rule, and their integrals. */
    Values
    integrate(unsigned int         cell,
              const Corners       &corners,
              double               measure,
              const Rule          &rule,
              std::vector<Values> &values) const;
    bool
    agree(const Values &a, const Values &b, const double *tolerances) const;
    void
    refine(unsigned int   cell,
           const Corners &corners,
           double         measure,
           const double  *tolerances,
           unsigned int   level,
           const Visitor &visitor) const;

    const mesh::TetMesh &mesh;
    const Densities     &densities;
    Rule                 low, middle, high, rim;
    /** Work space: densities at the points of the part at hand. */
    mutable std::vector<Values> values, others;
  };

  extern template class AdaptiveQuadrature<3>;
  extern template class AdaptiveQuadrature<4>;

  /** A cell of a mesh, or a face of it. */
  template <unsigned int n_corners>
  struct IntegrationPart
  {
    unsigned int                                    cell = 0;
    typename AdaptiveQuadrature<n_corners>::Corners corners{};
    double                                          measure = 0.; ///< volume or area
  };

  /** Is told each point: its cell, where in it, its weight times the measure, and the
   * densities. */
  using PointVisitor
    = std::function<void(unsigned int, const mesh::Barycentric &, double, const double *)>;

  /**
   * Visits the points of accurate rules on this rank's cells or faces.
   * @param part makes one of the @p n_parts of this rank.
   * @param accuracy of a part's integral, relative to that of |density| over all parts of
   *        all ranks.
   * Collective. @throws core::InputError on all ranks if a density throws on one.
   */
  template <unsigned int n_corners>
  void
  visit_parts(const mesh::TetMesh                                           &mesh,
              const Densities                                               &densities,
              unsigned int                                                   n_parts,
              const std::function<IntegrationPart<n_corners>(unsigned int)> &part,
              double                                                         accuracy,
              MPI_Comm                                                       communicator,
              const PointVisitor                                            &visitor);
} // namespace tetradapt::estimate

#endif
