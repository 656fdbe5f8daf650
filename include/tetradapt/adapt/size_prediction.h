// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_adapt_size_prediction_h
#define tetradapt_adapt_size_prediction_h

#include "tetradapt/adapt/gradation.h"
#include "tetradapt/adapt/size_field.h"

#include <vector>

namespace tetradapt::adapt
{
  /**
   * The size field of optimal_size_field() as a function of its scale s, and what
   * each scale is predicted to bring: the wanted size of cell K is
   * s e_K^(-2/(2p+3)) h_K, clamped; sizes of nodes follow from it, then the
   * gradation; and TetGen, which never coarsens, makes max(1, f (h_K/h)^3) cells
   * of cell K, the mean taken over K with h linear in it. The number of cells falls
   * and the error rises with s.
   */
  class SizePrediction
  {
  public:
    /** Keeps references to all but @p edges. @p indicators are finite, >= 0 and
     * not all zero. */
    SizePrediction(const mesh::TetMesh       &mesh,
                   const std::vector<double> &indicators,
                   const SizeFieldOptions    &options,
                   const mesh::EdgeTable     &edges);

    /** Logarithm of the scale that leads to @p n cells if nothing is clamped,
     * graded or too fine already: s = (S/n)^(1/3), S = sum e_K^(6/(2p+3)). */
    double
    guess(double n) const;

    /** Logarithms of the scales beyond which every cell is clamped. */
    double
    lowest() const
    {
      return lowest_log_scale;
    }
    double
    highest() const
    {
      return highest_log_scale;
    }

    /** Computes the field for the scale exp(@p log_scale). */
    void
    set_scale(double log_scale);

    /** Cells of the next mesh. */
    double
    n_tets() const
    {
      return predicted_tets;
    }

    /** The root of the sum of squared indicators on the next mesh over the present one,
     * each cell's contribution falling with (h/h_K)^rate. */
    double
    reduction() const;

    /** Root of the sum of squared indicators on the next mesh: the present one times
     * reduction() to the power options.reduction_power. */
    double
    error() const;

    /** The field, its figures and TetGen's sizes for the size control. */
    SizeField
    field() const;

  private:
    double
    wanted_size(unsigned int cell) const;
    void
    set_nodes_to_minimum();
    void
    set_nodes_to_mean();
    /** Mean over the cell of (h_K/h)^3, h linear between the vertices. */
    double
    density(unsigned int cell) const;
    /** Cells that TetGen makes of one cell; less than one where cells may grow. */
    double
    n_pieces(unsigned int cell) const;

    const mesh::TetMesh       &mesh;
    const std::vector<double> &indicators;
    const SizeFieldOptions    &options;
    Gradation                  gradation;
    double                     factor; ///< f, cells obtained over cells predicted

    std::vector<double> volumes, sizes;     ///< of the cells; sizes are equivalent edges
    std::vector<double> log_ratios;         ///< log of e_K^(-2/(2p+3))
    double              present_error = 0.; ///< root of the sum of squared indicators
    std::vector<double> point_volumes;      ///< of the cells around each point
    double              lowest_log_scale, highest_log_scale;

    double              log_scale = 0.;
    std::vector<double> node_sizes;
    double              predicted_tets = 0.;
    unsigned long       n_graded       = 0;
  };
} // namespace tetradapt::adapt

#endif
