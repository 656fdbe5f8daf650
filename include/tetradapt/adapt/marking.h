// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_adapt_marking_h
#define tetradapt_adapt_marking_h

#include "tetradapt/mesh/tet_mesh.h"
#include "tetradapt/scene/study_parameters.h"

#include <memory>
#include <vector>

namespace tetradapt::adapt
{
  /** Which cells a rule wants to be refined. */
  struct Marking
  {
    std::vector<unsigned int> cells; ///< numbers of the marked cells, ascending
    /** Smallest indicator of a marked cell over the largest of all: for the
     * maximum rule the lambda that was used, which is the given one unless it
     * had to be lowered. Zero if nothing is marked. */
    double lambda = 0.;
    /** Part of the sum of squared indicators that the marked cells hold. */
    double squared_share = 0.;
  };

  /**
   * A rule that chooses cells by their error indicators. Every rule is
   * deterministic (ties go to the lower cell number) and never marks a cell
   * whose indicator is zero: there is no error to reduce.
   */
  class Marker
  {
  public:
    virtual ~Marker() = default;

    /**
     * @param indicators eta_K >= 0, one a cell, in any unit.
     * @param mesh used only to say where a bad indicator lies.
     * @throws core::NumericalError if an indicator is not finite or negative, or
     *         if their number is not the number of cells.
     */
    Marking
    mark(const std::vector<double> &indicators, const mesh::TetMesh &mesh) const;

  private:
    /** @p indicators are checked, and at least one is positive. */
    virtual Marking
    choose(const std::vector<double> &indicators) const = 0;
  };

  /** All cells with eta_K >= lambda max eta. If these are fewer than the fraction
   * @p min_new of all cells, lambda is lowered until they are as many. */
  class MaximumMarker : public Marker
  {
  public:
    MaximumMarker(double lambda, double min_new);

  private:
    Marking
           choose(const std::vector<double> &indicators) const override;
    double lambda, min_new;
  };

  /** The ceil(fraction * N) cells with the largest indicators. */
  class FixedFractionMarker : public Marker
  {
  public:
    explicit FixedFractionMarker(double fraction);

  private:
    Marking
           choose(const std::vector<double> &indicators) const override;
    double fraction;
  };

  /** The smallest set of cells that holds the share @p theta of the sum of
   * squared indicators (W. Doerfler, SIAM J. Numer. Anal. 33, 1996). */
  class DoerflerMarker : public Marker
  {
  public:
    explicit DoerflerMarker(double theta);

  private:
    Marking
           choose(const std::vector<double> &indicators) const override;
    double theta;
  };

  /** The rule that @p parameters asks for; null for Marking::optimal_size, which
   * marks nothing but gives every cell a size (see size_field.h). */
  std::unique_ptr<Marker>
  make_marker(const scene::AdaptivityParameters &parameters);

  /**
   * Checks that there is one finite, non-negative indicator a cell.
   * @throws core::NumericalError naming the first bad cell and its centroid.
   */
  void
  check_indicators(const std::vector<double> &indicators, const mesh::TetMesh &mesh);
} // namespace tetradapt::adapt

#endif
