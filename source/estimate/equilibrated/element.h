// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_equilibrated_element_h
#define tetradapt_estimate_equilibrated_element_h

#include <array>
#include <vector>

namespace tetradapt::estimate
{
  /**
   * The stresses that equilibrate given forces in one tetrahedron: symmetric,
   * quadratic on each of the four parts into which the tetrahedron is cut from its
   * centroid (Alfeld's split), with tractions that are continuous between the
   * parts. This is the space of Johnson and Mercier (Numer. Math. 30, 1978;
   * Krizek, Apl. Mat. 27, 1982 in space) with one degree more. Given tractions of
   * degree 2 on the faces and a body force of degree 1, in equilibrium as a rigid
   * body, it holds stresses that equilibrate them at every point, and they differ
   * by 18 stresses without traction and body force.
   *
   * All that depends on the shape of the tetrahedron is a linear map: with x = x_0
   * + F X from the unit tetrahedron and J = det F, stress = F S F^T / J has the
   * tractions (as forces on a face) F t and the body force F b / J of S. So one
   * particular stress for every load and the 18 free ones are computed once, for
   * the unit tetrahedron with corners 0, e_x, e_y, e_z.
   *
   * A stress is held as 40 coefficients times six components xx, yy, zz, yz, zx,
   * xy: ten orthonormal polynomials (with respect to the unit tetrahedron's
   * volume) on each part.
   */
  class EquilibratedElement
  {
  public:
    static constexpr unsigned int n_coefficients = 40;
    static constexpr unsigned int n_stress       = 6 * n_coefficients;
    static constexpr unsigned int n_free         = 18;
    /** Moments of the traction on each face (in the order of
     * mesh::face_vertices), against six functions: the three barycentric
     * coordinates l_s of the face's corners, and 4 l_s l_(s+1) made orthogonal to
     * them, so that linear tractions have none of the latter: 4 l_s l_(s+1) - .6 (l_s
     * + l_(s+1)) + .2 l_(s+2). Three components each. After them the body force at the four
     * corners. */
    static constexpr unsigned int n_moments = 72;
    static constexpr unsigned int n_loads   = n_moments + 12;

    EquilibratedElement();

    /** The one of the program; made when it is first asked for. */
    static const EquilibratedElement &
    instance();

    /** The particular stress of each load: n_loads rows of n_stress numbers. */
    std::vector<double> particular;
    /** The stresses without load: n_free rows of n_stress numbers; orthonormal. */
    std::vector<double> free_stress;
    /** Products of pairs of stresses. For components p <= q in the order 00, 01, ..,
     * 05, 11, .. there is the L2 product of component p of the one and component q
     * of the other, plus that of q and p if they differ: 21 numbers a pair. Nine
     * pairs stand together, 21 times nine numbers. The pairs: */
    std::vector<double> free_products;   ///< of free stresses b <= a, a by a
    std::vector<double> mixed_products;  ///< of moment by moment and each free stress
    std::vector<double> moment_products; ///< of functions m <= n: 3 x 3 components each

    /**
     * Stresses of degree 3 without traction that balance quadratic body forces, one
     * for each of the six functions orthogonal_bubble() and each component: n_quadratic
     * rows of 2 n_stress numbers, on each part those of the ten polynomials of degree 2
     * and of ten more. Computed when it is first asked for.
     */
    static const std::vector<double>                               &
    quadratic_forces();
    static constexpr unsigned int n_quadratic = 18;

    /** 4 b_i b_k, i and k the ends of edge @p e, made orthogonal to linear functions. */
    static double
    orthogonal_bubble(unsigned int e, const std::array<double, 4> &b);

    /** Value of the stress with coefficients @p stress at a point of part @p part,
     * given by its barycentric coordinates in the tetrahedron. */
    static std::array<double, 6>
    value(const double *stress, unsigned int part, const std::array<double, 4> &b);

  private:
    void
    multiply_stresses();
  };
} // namespace tetradapt::estimate

#endif
