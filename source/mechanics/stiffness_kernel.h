// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_source_mechanics_stiffness_kernel_h
#define tetradapt_source_mechanics_stiffness_kernel_h

/**
 * The inner loops of the matrix-free stiffness of quadratic tetrahedra, compiled for
 * several instruction sets; the loader picks the best that the processor has.
 *
 * Cells come in batches of as many lanes as a cache line holds numbers; lane l of a
 * quantity k is entry k * lanes + l.
 */
namespace tetradapt::mechanics
{
  template <typename Number>
  constexpr unsigned int stiffness_lanes = 64 / sizeof(Number);

  /** How the tangents of a batch are stored, each times a quarter of the volume. */
  enum class TangentForm
  {
    isotropic,     ///< lambda, mu of the cell
    one_per_cell,  ///< upper triangle of the 6 x 6 Voigt matrix, 21 numbers
    four_per_cell, ///< the same at each quadrature point, 84 numbers
    full_per_point ///< upper triangle of the 9 x 9 matrix dP/dF at each point, 180 numbers
  };

  constexpr unsigned int
  tangent_size(TangentForm form)
  {
    switch (form)
      {
      case TangentForm::isotropic:
        return 2;
      case TangentForm::one_per_cell:
        return 21;
      case TangentForm::four_per_cell:
        return 84;
      default:
        return 180;
      }
  }

  /** Arrays of all batches. */
  template <typename Number>
  struct StiffnessBatches
  {
    const unsigned int *nodes; ///< 10 a cell: vertices, then edges in the mesh's order
    /** Of each batch: not zero if it has the last node of the vectors. */
    const unsigned char *at_end;
    const Number        *gradients; ///< 9: of barycentric coordinates 1, 2, 3; x, y, z each
    const Number        *tangents;  ///< tangent_size() of them
    TangentForm          form;
  };

  /** y += K x for the batches from @p begin to @p end; x and y have three components a
   * node. */
  template <typename Number>
  void
  apply_stiffness(const StiffnessBatches<Number> &batches,
                  unsigned int                    begin,
                  unsigned int                    end,
                  const Number                   *x,
                  Number                         *y);

  /** Adds each node's own block, nine numbers row by row, to @p blocks. */
  template <typename Number>
  void
  add_diagonal_blocks(const StiffnessBatches<Number> &batches,
                      unsigned int                    begin,
                      unsigned int                    end,
                      Number                         *blocks);
} // namespace tetradapt::mechanics

#endif
