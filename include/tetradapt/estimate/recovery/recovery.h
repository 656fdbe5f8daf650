// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_recovery_recovery_h
#define tetradapt_estimate_recovery_recovery_h

#include "tetradapt/estimate/cell_stress.h"
#include "tetradapt/estimate/given_loads.h"
#include "tetradapt/estimate/recovery/patches.h"
#include "tetradapt/estimate/recovery/polynomial_fit.h"

#include <mpi.h>

namespace tetradapt::estimate
{
  /**
   * Superconvergent patch recovery (Zienkiewicz and Zhu, IJNME 33, 1992) with the
   * equations of equilibrium (Wiberg, Abdulwahab and Ziukas, IJNME 37, 1994): around every
   * vertex, and separately in each region that meets there, a polynomial of the field's
   * degree is fitted to the stresses at the cells' superconvergent points (degree 1:
   * centroids; degree 2: the four Gauss points) and to what loads and supports say, see
   * StressConditions; in a cell the patches of its vertices are blended by the
   * barycentric coordinates.
   *
   * The stress is C : (eps(u_h) - eps_thermal). A patch with less than twice as many
   * points as coefficients, or whose points determine the polynomial badly (in corners,
   * in layers of one cell), is enlarged by the patches of its cells' vertices, twice at
   * most; where that does not help, the polynomial's degree is lowered.
   *
   * Quadratic polynomials around points of walls that the boundary is projected on are fitted
   * to 15 times as many points as they have coefficients, those of the patch and of the
   * nearest cells around it. Facets leave an error of the order h in the stresses of the
   * cells at the wall, which changes from facet to facet and is larger than that of quadratic
   * elements. A patch of few cells follows it, and magnifies it where its points lie nearly on
   * a quadric, as they do where a mesh is refined regularly: on a plane wall they lie exactly
   * on one, and the patch is enlarged anyway. (Measured on a cylinder of 68 000 cells: the
   * error of the recovered stress in the cells at the wall is 2.6 times that of the computed
   * one with patches of at least 5 cells, 0.54 times if badly determined ones are enlarged,
   * 0.43 times with these; 0.35 times with the whole next layer of cells, but on meshes of
   * 1 000 cells such patches are too large for a quadratic polynomial.)
   */
  class RecoveredStress
  {
  public:
    /**
     * Collective; every rank gets all of it. Keeps a reference to the mesh of @p u_h.
     *
     * @param stress of @p u_h.
     * @param loads what acts; null: nothing is known of the boundary and the inside.
     */
    RecoveredStress(const mesh::NodalField &u_h,
                    const CellStress       &stress,
                    const GivenLoads       *loads,
                    MPI_Comm                communicator);

    /** The recovered stress at a point of @p cell, given in both kinds of coordinates. */
    void
    at(const unsigned int       cell,
       const mesh::Barycentric &b,
       const Point<3>          &point,
       double                  *stress) const
    {
      std::fill(stress, stress + 6, 0.);
      for (unsigned int i = 0; i < 4; ++i)
        if (linear)
          add_polynomial<1>(patches.of_cell[cell][i], mesh.cells[cell][i], b[i], point, stress);
        else
          add_polynomial<2>(patches.of_cell[cell][i], mesh.cells[cell][i], b[i], point, stress);
    }

    /** Of the polynomials: 1 or 2. */
    unsigned int
    degree() const
    {
      return linear ? 1 : 2;
    }

    /** A patch's polynomial: its unit of length L, then the coefficients of the monomials (see
     * monomials()) in (x - vertex) / L, six stresses each. */
    const double *
    polynomial(const unsigned int patch) const
    {
      return &polynomials[std::size_t(patch) * (1 + 6 * n_monomials[degree()])];
    }

    /** The patches of the vertices of @p cell. */
    const std::array<unsigned int, 4> &
    patches_of_cell(const unsigned int cell) const
    {
      return patches.of_cell[cell];
    }

    /**
     * The highest derivatives of a patch's polynomial, which are constant.
     * @param result for degree 1 the derivatives by x, y, z, three times six numbers; for
     *        degree 2 those by xx, yy, zz, xy, yz, zx, six times six.
     */
    void
    highest_derivatives(const unsigned int patch, double (*result)[6]) const
    {
      const unsigned int begin = linear ? 1 : 4, end = linear ? 4 : 10;
      const double      *polynomial = this->polynomial(patch);
      for (unsigned int k = begin; k < end; ++k)
        {
          const double factor
            = linear ? 1. / polynomial[0] : (k < 7 ? 2. : 1.) / (polynomial[0] * polynomial[0]);
          for (unsigned int c = 0; c < 6; ++c)
            result[k - begin][c] = factor * polynomial[1 + 6 * k + c];
        }
    }

  private:
    /** Adds @p factor times the polynomial of a patch at @p point. */
    template <unsigned int degree>
    void
    add_polynomial(const unsigned int patch,
                   const unsigned int vertex,
                   const double       factor,
                   const Point<3>    &point,
                   double            *stress) const
    {
      constexpr unsigned int n          = n_monomials[degree];
      const double          *polynomial = this->polynomial(patch);
      const double           scale      = 1. / polynomial[0];
      const Point<3>        &center     = mesh.points[vertex];
      double                 m[n];
      monomials<degree>(scale * (point[0] - center[0]),
                        scale * (point[1] - center[1]),
                        scale * (point[2] - center[2]),
                        m);
      for (unsigned int k = 0; k < n; ++k)
        {
          const double weight = factor * m[k];
          for (unsigned int c = 0; c < 6; ++c)
            stress[c] += weight * polynomial[1 + 6 * k + c];
        }
    }

    const mesh::TetMesh &mesh;
    bool                 linear; ///< polynomials, else quadratic
    RecoveryPatches      patches;
    std::vector<double>  polynomials; ///< a patch: its unit of length, then the coefficients
  };

  /** A recovered-stress estimate of the error of a solution. */
  struct RecoveryEstimate
  {
    std::vector<double> cell_energy; ///< eta_K, energy norm, one a cell
    double              global = 0.; ///< square root of the sum of squares
  };

  /**
   * The estimate eta_K^2 = int_K (s*-s_h):C^-1:(s*-s_h) of Zienkiewicz and Zhu with the
   * RecoveredStress s*. The integral is taken with 4 points for degree 1 and with 14 for
   * degree 2: at the four Gauss points, where the stresses were taken, s*-s_h is far
   * smaller than elsewhere. Collective.
   *
   * @param scene whose loads and supports, selected on the field's mesh, the recovered
   *        stress has to fit; null: they are not known.
   */
  RecoveryEstimate
  recovery_estimate(const mesh::NodalField       &u_h,
                    const mechanics::MaterialMap &materials,
                    MPI_Comm                      communicator,
                    const scene::Scene           *scene = nullptr);
} // namespace tetradapt::estimate

#endif
