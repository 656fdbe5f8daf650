// SPDX-License-Identifier: AGPL-3.0-or-later
#include "flat_correction.h"

#include "pairing.h"
#include "rigid_modes.h"

namespace tetradapt::solve
{
  namespace
  {
    constexpr unsigned int smoother_degree = 2;
    /** Factors of the prolongations, in units of the inverse of the largest eigenvalue. */
    const std::vector<double> once{1.45};
    /** The inverse roots of the Chebyshev polynomial of the fourth kind and degree 2. The
     * rigid motions of aggregates shear where the body bends, and that costs (a / t)^2 times
     * its energy: in very flat cells one factor leaves too much. On the further levels a
     * second one would make the matrices several times larger. */
    const std::vector<double> twice{1.1056, 2.8944};
  } // namespace

  template <typename Number>
  FlatCorrection<Number>::FlatCorrection(const BlockRows<3, 3>    &matrix,
                                         const fem::Space         &space,
                                         const fem::FixedUnknowns &fixed,
                                         const FlatNodes          &flat,
                                         const double              scale)
    : clusters(cluster(flat, space, matrix)), jacobi(matrix, clusters, scale)
  {
    auto coarsening
      = coarsen(matrix, rigid_modes(space, fixed), space.vector_layout(), clusters, {}, 0.);
    if (!coarsening)
      return;
    prolongation = Prolongation<Number, 3>(coarsening->prolongation);
    for (auto &block : coarsening->coarse.rows.blocks)
      for (double &entry : block)
        entry *= scale;
    levels.emplace(
      std::move(coarsening->coarse),
      LevelRule{pair_twice<6>, flat.are_very_flat ? twice : once, once, smoother_degree});
  }

  template <typename Number>
  void
  FlatCorrection<Number>::correct(const VectorOf<Number> &residual, VectorOf<Number> &x) const
  {
    if (levels)
      levels->correct(prolongation, residual, x);
  }

  template class FlatCorrection<float>;
  template class FlatCorrection<double>;
} // namespace tetradapt::solve
