// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_mechanics_tangent_field_h
#define tetradapt_mechanics_tangent_field_h

#include "tetradapt/mechanics/material_map.h"

namespace tetradapt::mechanics
{
  /** Stiffness tensor as a symmetric matrix, in Voigt order xx, yy, zz, yz, xz, xy for
   * engineering shears. */
  using VoigtMatrix = std::array<std::array<double, 6>, 6>;

  VoigtMatrix
  to_voigt(const SymmetricTensor<4, 3> &C);

  /**
   * The tangents that a stiffness is made of: derivatives of the stress by the strain, each
   * with both minor and the major symmetry. Either one a cell, which for linear laws is one
   * a region, or one at each of the four quadrature points of every cell, as laws need
   * whose tangent follows the strain. Or derivatives dP/dF of laws that are not linear, which
   * have the major symmetry only: is_full().
   *
   * Quadrature point q of a cell has barycentric coordinate q = (5 + 3 sqrt 5) / 20, the
   * others (5 - sqrt 5) / 20 (Hammer and Stroud 1956); all four weigh the same.
   */
  class TangentField
  {
  public:
    /** The laws' tangents at rest, one a region of @p mesh. */
    TangentField(const MaterialMap &materials, const mesh::TetMesh &mesh);

    /**
     * Any tangents. @param which has n_points entries a cell of the mesh: numbers in
     * @p tensors. @param n_points is 1 or 4.
     */
    TangentField(const std::vector<SymmetricTensor<4, 3>> &tensors,
                 std::vector<unsigned int>                 which,
                 unsigned int                              n_points);

    /**
     * Derivatives dP/dF. @param first has an entry a cell of the mesh: the number in @p tangents
     * of the cell's first one, the others follow. Only the cells that a rank works on need one.
     * @param n_points is 1 or 4.
     */
    TangentField(std::vector<laws::Tangent> tangents,
                 std::vector<unsigned int>  first,
                 unsigned int               n_points);

    /** Whether full() is to be taken instead of at(). */
    bool
    is_full() const
    {
      return !full_tangents.empty();
    }
    /** dP/dF in cell @p cell at point @p q. */
    const laws::Tangent &
    full(unsigned int cell, unsigned int q) const
    {
      return full_tangents[which[cell] + (n_points == 1 ? 0 : q)];
    }

    /** Tangents in each cell: 1 or 4. */
    unsigned int
    points_per_cell() const
    {
      return n_points;
    }
    /** The tangent of cell @p cell of the mesh at point @p q (0 to 3). */
    const VoigtMatrix &
    at(unsigned int cell, unsigned int q) const
    {
      return matrices[which[cell * std::size_t(n_points) + (n_points == 1 ? 0 : q)]];
    }
    /** Whether all are those of isotropic elasticity, to rounding: [0][1] is lambda then,
     * and [3][3] is mu. */
    bool
    is_isotropic() const
    {
      return isotropic;
    }

  private:
    std::vector<VoigtMatrix>   matrices;
    std::vector<laws::Tangent> full_tangents;
    std::vector<unsigned int>  which;
    unsigned int               n_points;
    bool                       isotropic;
  };
} // namespace tetradapt::mechanics

#endif
