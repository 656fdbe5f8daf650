// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_estimate_recovery_patch_solver_h
#define tetradapt_estimate_recovery_patch_solver_h

#include "patch_system.h"

namespace tetradapt::estimate
{
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
    PatchSolver(const mesh::TetMesh    &mesh,
                const StressSamples    &samples,
                const CellMaterials    &materials,
                const StressConditions *conditions);

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
    void
    gather_conditions(unsigned int vertex, const std::vector<unsigned int> &cells);
    /** Faces of one plane after each other; on curved walls only those of the cells around
     * @p vertex. */
    void
    gather_faces(unsigned int vertex, const std::vector<unsigned int> &cells);

    const mesh::TetMesh    &mesh;
    const StressSamples    &samples;
    const CellMaterials    &materials;
    const StressConditions *conditions;

    typename PatchSystem<degree>::Input             input;
    PatchSystem<degree>                             system;
    std::vector<typename PatchSystem<degree>::Face> faces;  ///< of the patch
    std::vector<const double *>                     planes; ///< the different matrices of faces
    std::vector<double>                             forces; ///< of the patch, three a cell
    const ElasticMatrices                          *elastic = nullptr; ///< of input's metric
  };

  extern template class PatchSolver<0>;
  extern template class PatchSolver<1>;
  extern template class PatchSolver<2>;
} // namespace tetradapt::estimate

#endif
