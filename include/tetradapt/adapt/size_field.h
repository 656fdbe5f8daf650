// SPDX-License-Identifier: AGPL-3.0-or-later
#ifndef tetradapt_adapt_size_field_h
#define tetradapt_adapt_size_field_h

#include "tetradapt/adapt/marking.h"
#include "tetradapt/mesh/edges.h"
#include "tetradapt/mesh/sizing.h"
#include "tetradapt/mesh/tet_mesh.h"
#include "tetradapt/scene/study_parameters.h"

#include <memory>
#include <vector>

namespace tetradapt::adapt
{
  /** How a node's size follows from the sizes of the cells around it. Measured on
   * interpolation errors of functions with singular edges, the mean leads to 10 to
   * 30 % less error than the minimum for as many tetrahedra. */
  enum class NodalSize
  {
    minimum,       ///< the smallest
    geometric_mean ///< weighted by volume
  };

  /** What a size field is made from, apart from the mesh and its indicators. Lengths
   * in the mesh's unit. */
  struct SizeFieldOptions
  {
    scene::AdaptivityParameters::SizeControl size_control
      = scene::AdaptivityParameters::SizeControl::node_sizes;
    /** The p of the formula below. Every p leads to the same mesh in the end, one
     * with equal errors; a lower one puts more of the next cells where the largest
     * errors are. Measured: 1 is at edge singularities 5 to 10 % better than 2 for
     * solutions of degree 2 also and elsewhere no worse. */
    double order = 1.;
    /** Power of h with which the driving error falls, for predicting it. */
    double rate = 1.;
    /** Tetrahedra that the next mesh is to have. */
    double wanted_tets = 0.;
    /** Wanted root of the sum of squared indicators; 0: none. Fewer tetrahedra
     * than wanted_tets are asked for if they suffice. */
    double tolerance = 0.;
    /** The prediction aims at this part of the tolerance, since a little more
     * error than predicted would cost one more cycle. */
    double tolerance_safety = 0.95;
    /** For the same reason, the smallest growth that a tolerance leads to. */
    double min_growth = 1.25;
    /** Times wanted_tets are taken if that reaches the tolerance, for a mesh that just
     * misses it is followed by another one. */
    double growth_slack = 1.;
    double min_ratio = 1. / 3., max_ratio = 2.; ///< clamps of new over old size
    double min_size = 0., max_size = 0.;        ///< 0: none
    double gradation         = 0.3;             ///< h(x) <= h(y) + g |x-y|; 0: none
    double reduction         = 0.5;             ///< marked cells: new over old size
    double radius_edge_ratio = 1.414;           ///< TetGen's -q, for volume constraints
    /** The next mesh fills the body from scratch, so that cells may grow; else they are only
     * split. Sizes are given at nodes then. */
    bool coarsening = false;
    /** Tetrahedra obtained over tetrahedra predicted; 0: what was measured for this
     * size control on average. A caller that goes through several cycles can pass what
     * the last one told, next_obtained_over_predicted(). */
    double obtained_over_predicted = 0.;
    /** The error is predicted cell by cell, as if new sizes made all cells equally good; that
     * a mesh which is nearly so already has nothing to gain there, only the last cycle can
     * tell. The predicted reduction of the error is raised to this power:
     * next_reduction_power(). */
    double    reduction_power = 1.;
    NodalSize nodal_size      = NodalSize::geometric_mean;
  };

  /** Options as @p parameters say, for a solution of degree @p degree on a mesh of
   * @p n_cells cells: wanted_tets is growth * n_cells, but never above max_tets. */
  SizeFieldOptions
  make_size_field_options(const scene::AdaptivityParameters &parameters,
                          const scene::TetgenParameters     &tetgen,
                          unsigned int                       degree,
                          unsigned long                      n_cells);

  /** Sizes for TetGen, and what they are expected to bring. */
  struct SizeField
  {
    mesh::Sizing        sizing;
    std::vector<double> node_sizes; ///< wanted edge length, one a point
    double              predicted_tets  = 0.;
    double              predicted_error = 0.; ///< root of the sum of squared indicators
    /** The same over the present error, cell by cell (before reduction_power); 0: unknown. */
    double        predicted_reduction = 0.;
    unsigned long n_refined           = 0; ///< cells whose wanted size is below their own
    unsigned long n_clamped           = 0; ///< cells at min_ratio or min_size
    unsigned long n_graded            = 0; ///< points whose size the gradation lowered
    /** The factor that predicted_tets includes. */
    double obtained_over_predicted = 1.;
    bool   tolerance_bound         = false; ///< the tolerance, not wanted_tets, decided
  };

  /** The factor that is taken where options.obtained_over_predicted is 0. */
  double
  default_obtained_over_predicted(const SizeFieldOptions &options);

  /** The factor to pass as obtained_over_predicted in the next cycle, after TetGen
   * made @p obtained tetrahedra of @p field; within [0.5, 3], so that one strange
   * cycle does not spoil the next. */
  double
  next_obtained_over_predicted(const SizeField &field, unsigned long obtained);

  /** The power to pass as reduction_power in the next cycle, after the error became
   * @p obtained times what it was where the size field predicted @p predicted times (its
   * predicted_reduction): the quotient of their logarithms, within [0.3, 1.2]. Steps that
   * predicted less than a fifth teach nothing certain: the answer is then @p last. */
  double
  next_reduction_power(double predicted, double obtained, double last);

  /** Edge length of the regular tetrahedron of volume @p volume, (6 sqrt(2) V)^(1/3). */
  double
  equivalent_edge(double volume);

  /** Volume of the regular tetrahedron of edge length @p edge. */
  double
  regular_volume(double edge);

  /** TetGen's -a bound that leads to the mean volume 1: a bound is an upper bound,
   * and the mean stays below it by a factor that depends on -q (measured, see
   * the source). */
  double
  volume_bound_factor(double radius_edge_ratio);

  /**
   * The size field with the least error for a number of tetrahedra: the new size
   * of cell K is r_K h_K with r_K = s e_K^(-2/(2p+3)), which minimises
   * sum e_K^2 r_K^(2p) for a given sum of r_K^-3 (Lagrange multiplier; a cell cut into
   * r^-3 cells of size r h_K keeps r^(2p) of its squared error). The scale s is found by bracketing
   * so that the prediction meets the wanted number; the prediction includes the
   * clamps, the gradation, and that TetGen's refinement never coarsens:
   * N = sum_K max(1, mean over K of (h_K/h)^3), without the maximum where the options
   * allow coarsening.
   *
   * @param indicators e_K, one a cell; zeros are allowed.
   * @param edges of @p mesh; made here if null.
   * @throws core::NumericalError as check_indicators() does.
   */
  SizeField
  optimal_size_field(const mesh::TetMesh       &mesh,
                     const std::vector<double> &indicators,
                     const SizeFieldOptions    &options,
                     const mesh::EdgeTable     *edges = nullptr);

  /**
   * Sizes that refine the marked cells by options.reduction and leave the others
   * alone as far as TetGen's quality bounds allow. With volume constraints, marked
   * cells get a bound and others none. With node sizes, a vertex of a marked cell
   * gets the volume-weighted geometric mean of the sizes around it, those of
   * unmarked cells being the ones they have (measured: with the marked cells' size
   * alone, twice to four times as many cells appear, for less); other vertices get
   * a size at which TetGen splits no cell. No gradation, and predicted_tets counts
   * reduction^-3 a marked cell. Marked cells that would fall below min_size are
   * left alone and counted in n_clamped. Where the options allow coarsening, points of
   * unmarked cells get the size that they have.
   */
  SizeField
  marked_size_field(const mesh::TetMesh    &mesh,
                    const Marking          &marking,
                    const SizeFieldOptions &options);
} // namespace tetradapt::adapt

#endif
