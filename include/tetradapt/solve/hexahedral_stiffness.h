// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_solve_hexahedral_stiffness_h
#define tetradapt_solve_hexahedral_stiffness_h

#include "tetradapt/mechanics/material_map.h"
#include "tetradapt/solve/hexahedral_forest.h"

namespace tetradapt::solve
{
  /** The stiffness of one axis-parallel cell of one material with the law's tangent at
   * rest, by products of one-dimensional integrals, which are exact. */
  class HexahedralElement
  {
  public:
    HexahedralElement(unsigned int                      degree,
                      const Tensor<1, 3>               &size,
                      const mechanics::ConstitutiveLaw &law);

    unsigned int
    nodes_per_cell() const
    {
      return n * n * n;
    }
    /** Force on component @p i of node @p a by a displacement of component @p j of node
     * @p b. */
    double
    entry(unsigned int a, unsigned int i, unsigned int b, unsigned int j) const;

  private:
    unsigned int        n;         ///< nodes along an edge
    std::vector<double> integrals; ///< of phi_a phi_b, phi_a phi_b', phi_a' phi_b, phi_a' phi_b'
    double              coefficients[3][3][3][3]; ///< of the derivatives: i, k, j, l
  };

  /**
   * The stiffness of a HexahedralSpace of degree 1 to 3, applied cell by cell without
   * a matrix. The stiffness of an axis-parallel cell commutes with reflections in its
   * three middle planes if the material does: sums and differences of mirrored nodes
   * fall into eight sets that do not couple, which takes an eighth of the
   * multiplications. Eight cells are computed at a time.
   */
  class HexahedralStiffness
  {
  public:
    /** Keeps references to @p forest and @p space.
     * @throws core::InputError for a material that is not symmetric to the coordinate
     *         planes. */
    HexahedralStiffness(const HexahedralForest       &forest,
                        const HexahedralSpace        &space,
                        const mechanics::MaterialMap &materials);
    ~HexahedralStiffness();

    /** forces = K displacement, with all nodes free. Collective. */
    void
    vmult(Vector &forces, const Vector &displacement) const;

    /** The diagonal of K. Collective. */
    Vector
    diagonal() const;

    /** The element of an own cell, and by what its entries are to be multiplied. */
    const HexahedralElement &
    element(unsigned int cell) const;
    double
    scale(unsigned int cell) const
    {
      return scales[cell];
    }

  private:
    struct Kind;
    const HexahedralForest   &forest;
    const HexahedralSpace    &space;
    std::vector<Kind>         kinds;   ///< shape and material
    std::vector<unsigned int> kind_of; ///< own cells
    std::vector<double>       scales;
    std::vector<unsigned int> batches; ///< cells, eight a batch, of one kind; none fills up
  };
} // namespace tetradapt::solve

#endif
