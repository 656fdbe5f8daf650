// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_compare_patch_solver_h
#define tetradapt_compare_patch_solver_h

#include "tetradapt/compare/polynomial_fit.h"
#include "tetradapt/compare/stress_conditions.h"

namespace tetradapt::compare
{
  /** A point with the stress there. */
  struct StressSample
  {
    Point<3> point;
    double   stress[6];
  };

  /**
   * Fits a polynomial of degree @p degree to the stresses at the sampling points of a
   * patch, in the coordinates (x - center) / length, and to the conditions that a stress
   * satisfies.
   *
   * Distances to the samples are measured in the metric 2 mu C^-1 of the energy norm: a
   * condition is then met by the cheapest change of the stress, for nearly
   * incompressible materials by one of the pressure, whose samples are the least reliable.
   * (Measured: with the plain sum of squares the conditions make the estimate up to 40 % too
   * large for nu = .49, with this metric it is better than without them.)
   *
   * A fit to samples alone is the same in any metric, and the six components share one
   * matrix A. Inside, the equations of equilibrium G c = g, added with a matrix of
   * weights W, couple them: with B = A^-1 (x) C / (2 mu), c = c_0 - B G^T (G B G^T + W^-1)^-1
   * (G c_0 - g), a small system. At the boundary all coefficients are solved for together.
   */
  template <unsigned int degree>
  class PatchSolver
  {
  public:
    static constexpr unsigned int n = n_monomials[degree];

    /** @param conditions may be null. */
    PatchSolver(const mesh::TetMesh             &mesh,
                const std::vector<StressSample> &samples,
                unsigned int                     n_a_cell,
                const CellMaterials             &materials,
                const StressConditions          *conditions);

    /**
     * @param cells of the patch around point @p vertex of the mesh.
     * @param length the unit of the coordinates.
     * @param coefficients coefficients[6 i + c] belongs to monomial i and component c.
     * @return false if there are less than twice as many samples as coefficients, or if
     *         they do not determine the polynomial well: if a column's part that is
     *         orthogonal to the ones before is below 1e-3 of it.
     */
    bool
    solve(unsigned int                     vertex,
          const std::vector<unsigned int> &cells,
          double                          &length,
          double                          *coefficients);

  private:
    /** Monomials of degree p-1, in which the residual of equilibrium is. */
    static constexpr unsigned int n_lower = n_monomials[degree == 0 ? 0 : degree - 1];
    static constexpr unsigned int n_all   = 6 * n;

    void
    collect(const Point<3> &center, const std::vector<unsigned int> &cells);
    void
    collect_equilibrium(const Point<3> &center, const std::vector<unsigned int> &cells);
    void
    set_metric(const ElasticMatrices &elastic);
    /** What the correction of a fit inside the body is made of; see solve_inside(). */
    struct InnerSystem
    {
      double inverse[n_lower][n_lower];      ///< of the weights W of the residual of equilibrium
      double columns[3][n_lower][n];         ///< A^-1 D_j^T, D_j the derivative by x_j
      double slopes[3][3][n_lower][n_lower]; ///< D_l A^-1 D_j^T
    };

    /** Corrects the fit in solution so that the residual of equilibrium counts, too, by its
     * multipliers; does nothing where that is not determined. */
    void
    solve_inside();
    /** Sets the inverse and replaces targets by W^-1 targets; false if W is singular. */
    bool
    invert_weights(InnerSystem &system);
    void
    find_columns(InnerSystem &system) const;
    bool
    find_multipliers(const InnerSystem &system, double (&multipliers)[3 * n_lower]) const;
    bool
    solve_at_boundary(const Point<3> &center, const std::vector<unsigned int> &cells);
    void
    add_faces(const Point<3> &center, const std::vector<unsigned int> &cells);
    void
    add_face(const Point<3> &center, const StressConditions::Face &face);
    /** Adds the products of monomials, times a matrix between components, and clears them. */
    void
    add_products(const double (&of_components)[6][6]);
    void
    add_equilibrium();

    const mesh::TetMesh             &mesh;
    const std::vector<StressSample> &samples;
    unsigned int                     n_a_cell;
    const CellMaterials             &materials;
    const StressConditions          *conditions;

    double                metric[6][6], inverse_metric[6][6]; ///< between components
    double                length = 1., scale = 1.;            ///< scale: 1 / length
    PolynomialFit<degree> fit;
    double                factor[n][n], factor_scale[n];
    double                solution[6][n];
    double                weights[n_lower][n_lower]; ///< of the residual of equilibrium
    double                targets[3][n_lower];       ///< weights times -f length, as a polynomial
    double                products[n][n];            ///< of monomials, summed over points of faces
    double                matrix[n_all][n_all], matrix_scale[n_all], right[n_all];
  };

  extern template class PatchSolver<0>;
  extern template class PatchSolver<1>;
  extern template class PatchSolver<2>;
} // namespace tetradapt::compare

#endif
